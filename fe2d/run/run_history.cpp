#include "fe2d/run/run_history.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

HistoryRecorder::HistoryRecorder(const DynamicContact& dynamics, RunHistory& history)
    : dynamics_(dynamics), history_(history), weights_(dynamics.structure().plane().weights()),
      start_(dynamics.state().contact.slip)
{
    const Mesh& mesh = dynamics.structure().model().mesh;
    crest_ = 2 * dynamics.structure().order().new_node[mesh.crest.front()];
    crest_start_ = dynamics.state().u[crest_];
    history_ = {};
}

void HistoryRecorder::add()
{
    const DynamicState& s = dynamics_.state();
    const ContactMemory& c = s.contact;
    const VectorXd& area = dynamics_.structure().plane().area;
    const Index m = area.size();
    double open = 0.0, slipping = 0.0;
    for (Index i = 0; i < m; ++i) {
        const ContactState state = c.states[static_cast<std::size_t>(i)];
        if (state == ContactState::open) open += area[i];
        if (is_slip(state)) slipping += area[i];
    }
    history_.time.push_back(s.time);
    history_.ground_h.push_back(s.ground.h);
    history_.ground_v.push_back(s.ground.v);
    history_.slip.push_back(slip());
    history_.slip_heel.push_back(c.slip[0] - start_[0]);
    history_.slip_toe.push_back(c.slip[m - 1] - start_[m - 1]);
    history_.crest_x.push_back(s.u[crest_] - crest_start_);
    history_.normal_force.push_back(c.force.head(m).sum());
    history_.shear_force.push_back(-c.force.tail(m).sum());
    history_.open_length.push_back(open);
    history_.slipping_length.push_back(slipping);
    history_.largest_opening.push_back(c.opening.maxCoeff());
    history_.energy.push_back(dynamics_.energy());
    history_.imbalance.push_back(dynamics_.energy_imbalance());
}

} // namespace damslip::fe2d
