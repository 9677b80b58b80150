/* Together with own_functions.c, a library under the name of the expected ODE that has another precision. */

__attribute__((visibility("default"))) int dCheckConfiguration(const char *token)
{
    (void)token;
    return 0;
}
