#pragma once

#include "analysis/accuracy/hierarchy.hpp"

namespace damslip {

/// Runs single model levels of one scene. Nothing is shared between model levels, so each costs what it costs alone.
class ModelLevelRunner {
public:
    /// @param read_seconds  that reading scene and records took: every model level pays them
    /// @param watch  asked at every step of the record and between the parts of a set-up; outlives this
    ModelLevelRunner(Scene scene, Records records, double read_seconds, const Watch& watch);

    /// Once, with its seconds and memory. Input that a model level does not admit (mesh, law) and runs without an answer are a
    /// failed result, never a throw.
    ModelLevelResult run(const ModelLevel& model_level) const;

    /// What the set-up of a model level by finite elements takes at least, which no watch can end: the dense operators of its contact [s].
    double least_seconds(const ModelLevel& model_level) const;

    /// What decides about model levels; regressions are evaluated for it.
    HierarchyFacts facts() const;

private:
    bool rocks_first() const;
    void run_regression(const ModelLevel& model_level, ModelLevelResult& result) const;
    void run_model(const ModelLevel& model_level, ModelLevelResult& result) const;

    Scene scene_;
    Records records_;
    double read_seconds_;
    const Watch& watch_;
};

} // namespace damslip
