// An independent program in C++: two spheres overlap, and one is apart.

#include <iostream>

#include <ode_predictive_space/predictive_space.hpp>

namespace
{
void count_pair(void *data, dGeomID, dGeomID)
{
    ++*static_cast<int *>(data);
}

int count_pairs()
{
    dPredictiveSpace space;
    dSphere here(space, 1.0);
    dSphere overlapping(space, 1.0);
    dSphere apart(space, 1.0);
    overlapping.setPosition(1.5, 0.0, 0.0);
    apart.setPosition(9.0, 0.0, 0.0);
    int pairs = 0;
    space.collide(&pairs, &count_pair);
    return space.validate() ? pairs : -1;
}
} // namespace

int main()
{
    dInitODE2(0);
    const int pairs = count_pairs();
    dCloseODE();
    std::cout << "pairs: " << pairs << '\n';
    return pairs == 1 ? 0 : 1;
}
