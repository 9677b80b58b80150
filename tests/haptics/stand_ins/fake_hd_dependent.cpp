// A stand-in for OpenHaptics' HD library that needs an absent library, like the real one without its driver.

extern "C" int absent_driver();

extern "C" __attribute__((visibility("default"))) int hdInitDevice()
{
    return absent_driver();
}
