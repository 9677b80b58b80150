// A stand-in for OpenHaptics' HD library that needs a library which is not there, as the real one does without its
// driver.

extern "C" int absent_driver();

extern "C" __attribute__((visibility("default"))) int hdInitDevice()
{
    return absent_driver();
}
