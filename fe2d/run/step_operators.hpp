#pragma once

#include "fe2d/run/block_products.hpp"
#include "fe2d/run/dynamic_operator.hpp"

#include <map>
#include <memory>
#include <mutex>

namespace damslip::fe2d {

/// Everything of the steps that is linear, by step size: made when first asked for, then shared by all runs of one
/// structure, damping and scheme, whatever their friction and motion. Threads may ask at the same time.
class StepOperators {
public:
    /// @param radiating  the rock of the motion on the plane of the base, rows as the structure's rock nodes; null: the massless one
    StepOperators(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                  std::shared_ptr<const ReducedRock> radiating = {});
    StepOperators(const StepOperators&) = delete;
    StepOperators& operator=(const StepOperators&) = delete;

    const ContactStructure& structure() const { return structure_; }
    const RunDamping& damping() const { return damping_; }
    const SlipDamping& slip_damping() const { return slip_damping_; }
    const Scheme& scheme() const { return scheme_; }
    const ReducedRock* radiating() const { return radiating_.get(); } ///< null: rigid base or massless rock
    const BlockProducts& products() const { return products_; }

    const DynamicOperator& at(double dt); ///< @param dt  > 0 [s]
    int made() const;                     ///< factorisations so far

private:
    const ContactStructure& structure_;
    RunDamping damping_;
    Scheme scheme_;
    std::shared_ptr<const ReducedRock> radiating_;
    SlipDamping slip_damping_;
    BlockProducts products_;
    mutable std::mutex mutex_;
    std::map<double, std::unique_ptr<const DynamicOperator>> operators_;
};

} // namespace damslip::fe2d
