/* A program, or a library with run_scene(), that is served by own_functions.c. */

void *dHashSpaceCreate(void *parent);
void dSpaceCollide(void *space, void *data, void *callback);

__attribute__((visibility("default"))) void run_scene(void)
{
    dSpaceCollide(dHashSpaceCreate(0), 0, 0);
}

int main(void)
{
    run_scene();
    return 3;
}
