#pragma once

#include "analysis/accuracy/ladder.hpp"
#include "analysis/prepare/ready.hpp"

#include <functional>

namespace damslip {

/// Runs single rungs of one scene. Nothing is shared between rungs, so each costs what it costs alone.
class RungRunner {
public:
    /// @param read_seconds  that reading scene and records took: every rung pays them
    /// @param watch  asked at every step of the record and between the parts of a set-up; outlives this
    RungRunner(Scene scene, Records records, double read_seconds, const Watch& watch);

    /// Once, with its seconds and memory. Input that a rung does not admit (mesh, law) and runs without an answer are a
    /// failed result, never a throw.
    RungResult run(const Rung& rung) const;

    /// What the set-up of a rung by finite elements takes at least, which no watch can end: the dense operators of its contact [s].
    double least_seconds(const Rung& rung) const;

    /// What decides about rungs; regressions are evaluated for it.
    LadderFacts facts() const;

    const Scene& scene() const { return scene_; }
    const std::vector<RecordPair>& records() const { return *records_; }

private:
    bool rocks_first() const;
    void run_regression(const Rung& rung, RungResult& result) const;
    void run_rigid(const Scene& scene, RungResult& result) const;
    void run_finite_elements(const Scene& scene, RungResult& result) const;

    Scene scene_;
    Records records_;
    double read_seconds_;
    const Watch& watch_;
};

} // namespace damslip
