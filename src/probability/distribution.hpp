#pragma once

#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace damslip::probability {

/// A parameter of a distribution or a method that is outside its range. The reader of a scene adds file, line and key.
class ParameterError : public std::invalid_argument {
public:
    ParameterError(std::string parameter, std::string value, std::string expected);
    const std::string& parameter() const { return parameter_; } ///< "beta"
    const std::string& value() const { return value_; }         ///< as text: "-0.15"
    const std::string& expected() const { return expected_; }   ///< "a number > 0"

private:
    std::string parameter_, value_, expected_;
};

/// Distribution of one variable, as its cumulative distribution function F and the inverse. Values have the unit of the variable.
/// Made by the functions below; @throws ParameterError of each, where a parameter is not finite or outside its range.
class Distribution {
public:
    /// ln X normal about ln(median) with standard deviation beta; median > 0, beta > 0.
    static Distribution lognormal(double median, double beta);
    /// The same by mean m > 0 and coefficient of variation v > 0: beta^2 = ln(1 + v^2), median = m / sqrt(1 + v^2).
    static Distribution lognormal_of_mean(double mean, double cov);
    static Distribution normal(double mean, double sd);                   ///< sd > 0
    static Distribution uniform(double min, double max);                  ///< min < max
    static Distribution triangular(double min, double mode, double max);  ///< min <= mode <= max, min < max
    static Distribution beta(double a, double b, double min, double max); ///< a > 0, b > 0 on [min, max]
    /// Value k with weight k of the list, k = 0, 1, ...: a choice by its place. Weights > 0; scaled to a sum of 1.
    static Distribution discrete(std::vector<double> weights);

    /// The conditional law of X given min <= X <= max: F(x) becomes (F(x) - F(min)) / (F(max) - F(min)). Nothing is clipped.
    /// Infinite bounds are allowed. @throws ParameterError of what has no probability between the bounds, and of discrete ones
    Distribution truncated(double min, double max) const;

    double cdf(double x) const;      ///< P(X <= x); 0 below and 1 above the support
    double quantile(double u) const; ///< smallest x with F(x) >= u; 0 < u < 1, ends allowed: the ends of the support
    double lower() const { return min_; } ///< lower end of the support; -inf
    double upper() const { return max_; } ///< upper end of the support; +inf
    double median() const { return quantile(0.5); }
    bool is_discrete() const { return std::holds_alternative<Discrete>(law_); }

private:
    struct Lognormal {
        double log_median, beta;
    };
    struct Normal {
        double mean, sd;
    };
    struct Uniform {
        double min, max;
    };
    struct Triangular {
        double min, mode, max;
    };
    struct Beta {
        double a, b, min, max;
    };
    struct Discrete {
        std::vector<double> below; ///< below[k] = P(X <= k)
    };
    using Law = std::variant<Lognormal, Normal, Uniform, Triangular, Beta, Discrete>;
    explicit Distribution(Law law);

    double whole_cdf(double x) const;
    double whole_upper(double x) const; ///< 1 - F(x), accurate in the upper tail
    double whole_quantile(double u) const;
    double whole_upper_quantile(double v) const; ///< x with 1 - F(x) = v

    Law law_;
    double min_, max_;                 ///< of the support, after truncation
    double below_ = 0.0, share_ = 1.0; ///< F(min), F(max) - F(min) of the law as a whole
    double above_ = 0.0;               ///< 1 - F(max)
    bool from_above_ = false;          ///< the part kept lies in the upper half: it is measured by 1 - F
};

/// The standard normal distribution, accurate in both tails.

double normal_cdf(double z);     ///< Phi(z); relative accuracy also where it is tiny

/// ln Phi(z), finite down to z = -1e150.
double log_normal_cdf(double z);

/// phi(z) / Phi(z), the inverse Mills ratio: z -> -inf: -z, z -> inf: 0.
double mills(double z);

/// z with Phi(z) = u. u = 0 and u = 1: minus and plus infinity; outside [0, 1]: NaN.
double normal_quantile(double u);

} // namespace damslip::probability
