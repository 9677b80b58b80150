// Allocations that fail on purpose: the n-th one throws std::bad_alloc.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_FAULTS_ALLOCATION_FAULTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_FAULTS_ALLOCATION_FAULTS_H

namespace ode_predictive_space
{
/// During its lifetime, the allocation after `spared` others fails; later ones succeed again.
class AllocationFault
{
public:
    explicit AllocationFault(long spared);
    ~AllocationFault();
    AllocationFault(const AllocationFault &) = delete;
    AllocationFault &operator=(const AllocationFault &) = delete;

    bool struck() const;
};
} // namespace ode_predictive_space

#endif
