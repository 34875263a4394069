#pragma once

#include <Eigen/Core>

#include <cstdio>
#include <memory>
#include <vector>

namespace damslip::fe2d {

/// Everything of one instant of a run that a picture shows: dam, rock, water, and the joints.
struct RunFrame {
    double time = 0.0;                              ///< [s]
    double mean_slip = 0.0;                         ///< of the base, area mean since the static state [m]
    Eigen::VectorXd dam;                            ///< as StoredState::dam [m]
    Eigen::VectorXd rock;                           ///< as StoredState::rock [m]
    Eigen::VectorXd pressure, shear, slip, opening; ///< of the pairs of all planes; signs as PairHistory [Pa, Pa, m, m]
    Eigen::VectorXd
        joint_water;            ///< of the base's pairs, in a joint whose water follows its opening [Pa]; empty: others
    Eigen::VectorXd water;      ///< beyond the static one, at the nodes of acoustic water [Pa]; empty: other water
    std::vector<double> states; ///< of all pairs, ContactState as a number
};

/// Frames of one pass of a run at equal intervals, in a file without a name: the memory does not grow with their number,
/// and the file goes with the last who holds it.
class FrameSpool {
public:
    /// @param interval  between frames, > 0 [s] @throws InputError where no file can be had
    explicit FrameSpool(double interval);

    /// Has the interval passed since the frame before? The first row of a history always gives one.
    bool due(double time) const { return count() == 0 || time >= next_ - 1e-9; }
    void add(const RunFrame& frame); ///< @throws InputError when the disk is full
    std::size_t count() const { return places_.size(); }
    double last_time() const { return last_; } ///< of the last frame [s] @pre count() > 0
    RunFrame read(std::size_t index) const;    ///< @pre index < count()

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<long> places_; ///< of the frames, bytes from the start
    double interval_, next_ = 0.0, last_ = 0.0;
};

} // namespace damslip::fe2d
