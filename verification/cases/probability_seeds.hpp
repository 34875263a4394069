#pragma once

#include <cstdint>

/// What estimators do over many seeds.
namespace damslip::verification {

/// Many estimates of one known value.
struct SeedStudy {
    static constexpr int few = 300; ///< first seeds, looked at by themselves, too
    int seeds = 0;
    double exact = 0.0, mean = 0.0; ///< of the estimates
    double sd = 0.0;                ///< between the estimates
    double mean_se = 0.0;           ///< root of the mean of the squared standard errors they state
    int covered = 0;                ///< intervals of 95 % that hold the exact value
    int covered_of_few = 0;         ///< of the first seeds

    double bound() const; ///< 4 sd / sqrt(seeds): |mean - exact| of an unbiased estimate
};

enum class CheapModel {
    good,     ///< slip of the dear model with a scatter of 0.3 of its logarithm
    worthless ///< independent of the dear model
};
enum class SuiteOf {
    all_records, ///< each sample a record of its own
    ten_records  ///< ten records of strong effect, the same ones in every seed: P of that suite is the exact value
};

/// P(ln D > 0), ln D normal with the mean -1.2 and the standard deviation 1, half of its variance of the record: n dear, 10 n cheap samples.
SeedStudy study_two_level(int seeds, int n, CheapModel cheap, SuiteOf suite);

/// Multifidelity Monte Carlo of three models, correlations 0.95 and 0.8, costs 1, 0.05, 0.002, m_1 of some twenty. The exact value is 0.
SeedStudy study_mfmc(int seeds, double* variance_by_formula);

} // namespace damslip::verification
