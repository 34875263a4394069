#include "records/measure/measures.hpp"

#include "records/measure/intensity.hpp"
#include "records/measure/mean_period.hpp"
#include "records/measure/peaks.hpp"

namespace damslip::records {

Measures measure(const Record& record)
{
    const std::span<const double> accel = record.acceleration;
    const Peaks peaks = motion_peaks(accel, record.dt);
    Measures m;
    m.duration = record.duration();
    m.pga = peaks.acceleration;
    m.pga_time = peaks.acceleration_time;
    m.pgv = peaks.velocity;
    m.pgd = peaks.displacement;
    m.final_velocity = peaks.final_velocity;
    m.final_displacement = peaks.final_displacement;
    m.arias_intensity = arias_intensity(accel, record.dt);
    m.cumulative_velocity = cumulative_absolute_velocity(accel, record.dt);
    m.duration_5_75 = significant_duration(accel, record.dt, 0.05, 0.75);
    m.duration_5_95 = significant_duration(accel, record.dt, 0.05, 0.95);
    m.mean_period = mean_period(accel, record.dt);
    return m;
}

} // namespace damslip::records
