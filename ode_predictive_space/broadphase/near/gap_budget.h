// Bounds the cost of looks at the gaps of pairs. In: the instructions of looks, and the reports that they saved. Out: whether a look is
// allowed.

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
/// Each object whose contacts are costly to find has an account, in instructions. A look at one of its pairs is drawn from it. Each
/// report that a look has spared pays in what the contacts would have cost, and each other report pays in a small part of that. While
/// the account is overdrawn, the pairs of the object are tested by box. So looks that spare nothing cost no more than that part of the
/// reports, beside the allowance with which an account begins. All of it is counted: callbacks are the same in every run.
class GapBudget
{
public:
    void begin_report() { ++report_; }

    /// There is one more pair of the object. Each account begins with an allowance for each pair that becomes near at the same time.
    void note_new_pair(ProxyId id)
    {
        if (id >= accounts_.size())
            accounts_.resize(id + std::size_t{1});
        Account &account = accounts_[id];
        if (account.report != report_)
            account.new_pairs = 0;
        account.report = report_;
        ++account.new_pairs;
        const float allowance = tuning::allowed_reports * tuning::cost_of_contacts;
        if (static_cast<float>(account.new_pairs) * allowance > account.most)
        {
            account.most += allowance;
            account.balance += allowance;
        }
    }

    /// @pre the object has had a pair; note_spared(), note_reported() and note_check() need one, too.
    bool allows_check(ProxyId id) const { return accounts_[id].balance >= 0; }

    /// A pair was not reported, because of an earlier look.
    void note_spared(ProxyId id)
    {
        Account &account = accounts_[id];
        account.balance = std::min(account.balance + tuning::cost_of_contacts, account.most);
    }

    /// A pair was reported without a look.
    void note_reported(ProxyId id) { accounts_[id].balance += tuning::part_for_checks * tuning::cost_of_contacts; }

    /// A look took so much work; see Gap::work.
    void note_check(ProxyId id, float work)
    {
        accounts_[id].balance -= tuning::cost_of_check + tuning::cost_of_reach * work;
    }

    /// The object has a hull that was made of its data. The first one is free of charge; each point or triangle of a later one costs
    /// about as much as a look. It need not have had a pair.
    ///
    /// @param number of the hull.
    void note_hull(ProxyId id, std::uint32_t number, std::size_t elements)
    {
        if (id >= accounts_.size())
            return;
        Account &account = accounts_[id];
        if (account.hull != 0 && account.hull != number)
            account.balance -= tuning::cost_of_check * static_cast<float>(elements);
        account.hull = number;
    }

    /// The object is gone. It need not have had a pair.
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
        float most = 0; ///< of the balance: the sum of all allowances
        std::uint32_t report = 0;
        std::uint32_t new_pairs = 0; ///< in this report
        std::uint32_t hull = 0;      ///< the number of its last one
    };

    std::vector<Account> accounts_; // of the objects
    std::uint32_t report_ = 0;
};
} // namespace ode_predictive_space

#endif
