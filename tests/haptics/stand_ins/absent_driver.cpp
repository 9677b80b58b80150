// A library that is present when its user is linked, and absent when that is loaded.

extern "C" __attribute__((visibility("default"))) int absent_driver()
{
    return 0;
}
