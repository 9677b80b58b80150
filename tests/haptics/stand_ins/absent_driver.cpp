// The library that is there when the one that needs it is linked, and not when that is loaded.

extern "C" __attribute__((visibility("default"))) int absent_driver()
{
    return 0;
}
