// Bounds the cost of gap checks. In: instructions of checks, and reports that they saved. Out: whether a check is allowed.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_GAP_BUDGET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_GAP_BUDGET_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// Each object with costly contacts has an account, in contacts. Gap checks draw from it, and reports pay in: one, the cost of their
/// contacts, if a check has saved them, otherwise a small part of that. While the account is overdrawn, the object's pairs are
/// tested by box. Costs are computed, not measured, so that callbacks are the same in every run.
class GapBudget
{
public:
    void begin_report() { ++report_; }

    /// Counts a new pair of the object. Its allowances cover the largest number of new pairs in one report.
    void note_new_pair(ProxyId id)
    {
        if (id >= accounts_.size())
            accounts_.resize(id + std::size_t{1});
        Account &account = accounts_[id];
        if (account.report != report_)
            account.new_pairs = 0;
        account.report = report_;
        ++account.new_pairs;
        if (static_cast<float>(account.new_pairs) * tuning::allowed_reports > account.most)
        {
            account.most += tuning::allowed_reports;
            account.balance += tuning::allowed_reports;
        }
    }

    /// @pre for this and the next three: note_new_pair() was called for the object.
    bool allows_check(ProxyId id) const { return accounts_[id].balance >= 0; }

    void note_spared(ProxyId id)
    {
        Account &account = accounts_[id];
        account.balance = std::min(account.balance + 1, account.most);
    }

    void note_reported(ProxyId id) { accounts_[id].balance += tuning::part_for_checks; }

    void note_check(ProxyId id, float work)
    {
        accounts_[id].balance -= tuning::cost_of_check + tuning::cost_of_reach * work;
    }

    /// Charges for a new hull of the object: the first is free, an element of a later one costs about as much as a check.
    void note_hull(ProxyId id, std::uint32_t number, std::size_t elements)
    {
        if (id >= accounts_.size())
            return;
        Account &account = accounts_[id];
        if (account.hull != 0 && account.hull != number)
            account.balance -= tuning::cost_of_check * static_cast<float>(elements);
        account.hull = number;
    }

    void close(ProxyId id)
    {
        if (id < accounts_.size())
            accounts_[id] = {};
    }

    std::size_t bytes() const { return bytes_of(accounts_); }

private:
    struct Account
    {
        float balance = 0;
        float most = 0;              ///< sum of all allowances, up to which note_spared() fills the account
        std::uint32_t report = 0;    ///< the last one with new pairs
        std::uint32_t new_pairs = 0; ///< in that report
        std::uint32_t hull = 0;      ///< number of the last one
    };

    std::vector<Account> accounts_; // by object
    std::uint32_t report_ = 0;
};
} // namespace ode_predictive_space

#endif
