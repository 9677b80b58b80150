/* A program that is served by own_functions.c. */

void *dHashSpaceCreate(void *parent);
void dSpaceCollide(void *space, void *data, void *callback);

int main(void)
{
    dSpaceCollide(dHashSpaceCreate(0), 0, 0);
    return 3;
}
