#pragma once

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "scene/joint_laws.hpp"
#include "scene/rock_wedge.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A checked scene in SI units, defaults filled in, never changed after reading. What an optional does not hold is not
/// there: no reservoir, no water; it is neither assembled nor stored. The keys, their units, ranges and meanings:
/// keys.cpp.
///
/// Axes: x downstream, y up, heel of the dam at the origin. Forces are per metre of dam length.
namespace damslip {

/// Cross-section of the dam or block, a simple polygon in counter-clockwise order that starts with the heel at (0, 0)
/// and goes on to the toe: its first edge is the base. The upstream face is the chain from the last vertex back to the
/// heel.
struct Section {
    Polyline polygon;
    bool rock_slope = false; ///< given by the dimensions of a rock slope: a block of rock, not a dam
    /// x = above the heel [m], y = share of the monolith's width that is concrete [-]; an elevation given twice is a step.
    /// Empty: 1
    Polyline thickness = {};
};

enum class BodyCrack { none, traced }; ///< FE: the concrete stays whole; cracks are followed where it would crack

/// Linear elastic, plane strain.
struct Material {
    double density = 0.0;                ///< [kg/m^3]; 0: massless
    std::optional<double> young_modulus; ///< [Pa]; needed by FE commands only
    double poisson_ratio = 0.2;          ///< [-]
    std::optional<double> tensile_strength = {}; ///< of the dam's concrete, for what FE runs say of cracks [Pa]
    BodyCrack crack = BodyCrack::none;           ///< of the dam's concrete
    double crack_friction = 1.0;                 ///< μ of a traced crack [-]
    double tension_energy = 200.0, shear_energy = 2000.0; ///< G_I, G_II of a traced crack [N/m]
};

enum class RockMass { massless, with_mass }; ///< does the rock move with inertia, or only give way
/// Edges of rock with mass: of the box of the statics, fixed normal to themselves or with dashpots; or absorbing, of a box of
/// their own that is reduced to the base.
enum class RockBoundary { fixed, viscous, absorbing };

/// Flexible rock below the dam; without it the FE base is rigid.
struct Foundation {
    Material material;                               ///< its density is inertia only where `mass` says so
    RockMass mass = RockMass::with_mass;             ///< FE runs
    RockBoundary boundary = RockBoundary::absorbing; ///< of rock with mass; statics always stand on fixed edges
    double width = 0.0;                              ///< of the box, centred on the base [m]
    double depth = 0.0;                              ///< below the heel [m]
    double permeability = 1e-4;                      ///< hydraulic conductivity [m/s]
    std::optional<double> k0 = {}; ///< below a seam: horizontal over vertical stress of its weight [-]; none: ν/(1 - ν), as elastic rock has it
    Polyline ground = {}; ///< surface of the rock, from upstream to downstream [m]; empty: level at heel and toe; sliding planes only

    // Of the box in which waves travel, with absorbing edges.
    double wave_box = 1.0;                     ///< its size over the automatic one [-]
    std::optional<double> wave_frequency = {}; ///< up to which waves are right [Hz]; default: by the records
};

/// Grout curtain below the base.
struct Curtain {
    double distance = 0.0;               ///< upstream side of the curtain, from the heel [m]
    double depth = 30.0;                 ///< below the base [m]
    double thickness = 1.0;              ///< [m]
    std::optional<double> young_modulus; ///< [Pa]; default: the rock's
    double poisson_ratio = 0.2;          ///< [-]
    double permeability = 1e-8;          ///< [m/s]
    bool intact = true;                  ///< false: ruptured, it neither holds water back nor lowers the uplift
};

enum class ReservoirModel { automatic, hydrostatic, added_mass, acoustic };
enum class WaterSurface { free, sloshing };            ///< p = 0, or a surface that rises and falls
enum class FarEnd { absorbing, damper, closed, open }; ///< waves leave; the same at normal incidence only; wall; p = 0
enum class BottomMotion { ground, still };             ///< the reservoir bottom moves with the ground, or not at all
enum class ReservoirFloor { absorbing, rock }; ///< waves are absorbed by alpha, or the floor is the radiating rock

struct Reservoir {
    double level = 0.0;           ///< water surface above the heel [m]
    double density = 1000.0;      ///< [kg/m^3]
    double bulk_modulus = 2200e6; ///< [Pa]
    double length = 0.0;          ///< of the acoustic reservoir [m]; default 2.4 x level
    ReservoirModel model = ReservoirModel::automatic;
    bool floor_pressure = false; ///< water pressure on the reservoir floor loads the rock
    bool overtopped = false;     ///< what is above the crest flows over it and stands on it

    // Acoustic water only.
    WaterSurface surface = WaterSurface::free;
    FarEnd far_end = FarEnd::absorbing;
    BottomMotion bottom_motion = BottomMotion::ground;
    double bottom_reflection = 0.75; ///< alpha of pressure waves on the bottom, -1 (p = 0) ... 1 (rigid) [-]
    std::optional<double> bottom_density = {},
                          bottom_modulus = {}; ///< of what lies there [kg/m^3], [Pa]: give alpha instead
    std::optional<double> mesh_size = {};      ///< element height in the water [m]; default level / 20
    ReservoirFloor floor = ReservoirFloor::absorbing;
};

/// Gates in the plane of the upstream face, from its upper end up: they hold the water, and the crest is dry.
struct Gate {
    double top = 0.0; ///< above the heel [m]
};

/// Formulas the program asks for by name; others are rows of added_mass_rows() beyond these.
enum class AddedMassFormula { westergaard, westergaard_simplified, zangar, goldgruber };
/// m_n = m / cos(phi); the printed m_n = m; or of the first the horizontal part alone, as in codes and textbooks.
enum class InclinedFaceRule { normal_component, printed, horizontal };

struct AddedMass {
    AddedMassFormula formula = AddedMassFormula::westergaard;
    std::optional<double> period; ///< T of (3-1) [s]; none: infinite (incompressible)
    bool period_of_dam = false;   ///< T is the dam's own first period, found by iteration on the FE model
    InclinedFaceRule inclined_face = InclinedFaceRule::normal_component;
    std::vector<Point>
        zangar_table; ///< x = face angle from the vertical [rad], y = C_m [-]; empty: 0.73 (1 - phi/90 deg)
};

struct Tailwater {
    double level = 0.0; ///< water surface above the heel [m]
};

/// Sediment on the upstream face: thrust 1/2 K_s gamma' h^2.
struct Silt {
    double level = 0.0;                 ///< top of the sediment above the heel [m]
    double submerged_unit_weight = 0.0; ///< gamma' [N/m^3]
    double pressure_coefficient = 0.0;  ///< K_s [-]
};

struct Ice {
    double force = 0.0; ///< thrust, positive downstream [N/m]
    double level = 0.0; ///< where it acts above the heel [m]; default: water surface
};

struct PointForce {
    std::string name;
    Point at;             ///< [m]
    double force_x = 0.0; ///< positive downstream [N/m]
    double force_y = 0.0; ///< positive up [N/m]
};

enum class UpliftModel { none, linear, curtain, drains, points, seepage };
enum class CrackRule { none, fixed_static, seismic_zero, seismic_unchanged, seismic_full };

struct Uplift {
    UpliftModel model = UpliftModel::linear;
    double curtain_ratio =
        2.0 / 3.0;             ///< model `curtain`: pressure head just behind the curtain over the head difference [-]
    std::vector<Point> points; ///< model `points`: x = distance along the base from the heel [m], y = p / p_heel [-]; a
                               ///< repeated x is a jump
    CrackRule crack = CrackRule::none;
    JointWaterLaw water; ///< in the joint while it opens
};

/// Drain line below the base (USACE EM 1110-2-2200): H3 = H2 + (1 - E)(H1 - H2)(L - X)/L.
struct Drains {
    double distance = 0.0;         ///< X, from the heel [m]
    double efficiency = 2.0 / 3.0; ///< E [-]
    std::optional<double> depth;   ///< of the line below the base, for seepage [m]; default half the curtain's, without
                                   ///< curtain a quarter of the base
    std::optional<double> gallery_level; ///< above the heel [m]; takes the place of the tailwater when it is higher
    std::optional<double> lost_at_slip;  ///< slip at which the drains shear off, E = 0 from then on [m]
};

enum class Interpolation { steps, linear };
enum class JointPath { small, finite }; ///< FE: nodes stay opposite each other, or face the rock they have slid to

enum class JointOpening { allowed, none };                        ///< none: a modelling shortcut, see Contact
enum class ContactEnforcement { exact, penalty, slip_tolerance }; ///< of sticking: rigid, or with elastic slip first

enum class NormalContact { hard, exponential }; ///< exponential: soft, see Contact

/// Strength of the base. Cohesion acts on the compressed length until the first slip.
struct Contact {
    double friction = 0.0;                   ///< Coulomb mu, peak [-]
    double cohesion = 0.0;                   ///< c [Pa]
    bool cohesion_lost_at_slip = true;       ///< cohesion is gone from the first slip on
    std::optional<double> residual_friction; ///< mu after `residual_slip` [-]
    double residual_slip = 0.0; ///< accumulated slip at which the residual value is reached [m]; 0: at first slip
    Interpolation residual_path =
        Interpolation::steps;          ///< between peak and residual: a step at residual_slip, or linear in slip
    std::vector<Point> friction_table; ///< x = accumulated slip [m], y = mu [-]; replaces peak/residual
    Bond bond;                         ///< how cohesion is lost, and what stands beside it
    RateFriction rate;                 ///< friction over the rate of slip
    double restitution = 0.0;          ///< of landings of the whole base: rate after over rate before, 0 ... 1 [-]

    // FE runs only.
    JointOpening separation = JointOpening::allowed; ///< none: the joint pulls; lowers the slip, breaks the rigid limit
    ContactEnforcement enforcement = ContactEnforcement::exact;
    std::optional<double> tangential_stiffness; ///< of enforcement `penalty` [N/m^3]
    double slip_tolerance = 0.005; ///< F_f of enforcement `slip_tolerance`: elastic slip F_f x element length [-]
    NormalContact normal = NormalContact::hard;
    double pressure_at_zero_clearance = 1e6;  ///< p0 of normal contact `exponential` [Pa]
    double clearance_at_zero_pressure = 1e-3; ///< c0 of it: pressure acts from this clearance on [m]
    JointPath sliding = JointPath::small;
    double max_slip = 1.0; ///< with finite sliding the dam may go this far downstream [m]
};

enum class JointWater {
    none,
    linear ///< full head of the upstream water at the upstream face to that of the tailwater at the downstream face
};

/// A horizontal joint through the dam that may slide and open: a lift joint, a crack below the crest. FE runs only; in
/// limit equilibrium and for the rigid block the dam is one piece.
struct LiftJoint {
    std::string name;
    double elevation = 0.0; ///< above the heel [m]
    Contact strength; ///< friction, cohesion, bond, residual values and table only; the members for FE runs keep their
                      ///< defaults, [contact] says them for all planes
    JointWater water = JointWater::none;
    std::vector<Point> pressures = {}; ///< of a lift of [lifts]: x = from the upstream face [m], y = of its water [Pa]
    Polyline path = {}; ///< of a traced crack, x rising from the upstream to the downstream face; empty: level at `elevation`
};

enum class LiftUplift { none, linear, drains };
enum class Amplification {
    constant, ///< the dam moves as the ground
    power,    ///< A = 1 + (A_c - 1) (y/H)^n over the height
    points,   ///< as given
    modes     ///< natural modes of the tied FE model and the spectrum of each record
};
enum class ActiveLifts { adaptive, all, none }; ///< FE: where the strength is nearly reached; all; all tied

/// Horizontal joints through the dam at regular heights, each judged as a sliding plane.
struct Lifts {
    std::optional<double> spacing;  ///< from `from` up [m]; in place of `elevations`
    std::vector<double> elevations; ///< above the heel, from the bottom up [m]
    std::optional<double> from, to; ///< of the spacing [m]; none: one spacing above the heel, the crest
    bool bonded = false;            ///< with cohesion and tensile strength; else c = f_t = 0
    Contact strength;               ///< friction, cohesion, bond and residual values; the rest is that of [contact]
    LiftUplift uplift = LiftUplift::linear;
    std::optional<double> drains_distance; ///< from the upstream face [m]
    double drains_efficiency = 2.0 / 3.0;  ///< E [-]
    std::optional<double> gallery_level;   ///< above the heel, takes the place of the tailwater when higher [m]
    double uplift_share = 1.0;             ///< of the area on which the pressure acts [-]
    Amplification amplification = Amplification::constant;
    double crest_amplification = 1.0; ///< A_c [-]
    double exponent = 1.5;            ///< n [-]
    std::vector<Point> points;        ///< x = above the heel [m], y = A [-]
    ActiveLifts active = ActiveLifts::adaptive;
};

enum class SeamHeel {
    crack, ///< vertical, from the heel down to the seam: full water, no strength
    floor  ///< the seam itself starts on the reservoir floor
};
enum class SeamExit { daylight, wedge, free_face };
enum class InterfaceModel { smooth, friction };

/// The face between two blocks of a seam, at a kink.
struct SeamInterface {
    InterfaceModel model = InterfaceModel::smooth;
    std::optional<double> angle; ///< from the horizontal, of the upward face [rad]; none: vertical
    double friction = 0.0;       ///< [-]
    double cohesion = 0.0;       ///< [Pa]
    friend bool operator==(const SeamInterface&, const SeamInterface&) = default;
};

/// The wedge of rock that a dam on a seam pushes up in front of its toe.
struct SeamWedge {
    std::vector<double> angles; ///< α, that of its plane above the horizontal: one, or the joint sets to try [rad]; none: searched
    double search_from = 0.17453292519943295, search_to = 1.0471975511965976; ///< range of the search [rad]
    double distance = 0.0; ///< of the kink beyond the toe [m]
    double friction = 0.0; ///< of its plane [-]
    double cohesion = 0.0; ///< of its plane [Pa]
    double dilation = 0.0; ///< ψ of its plane [rad]
};

/// A weak seam in the rock below the dam: its path, and the body of dam and rock that slides on it.
struct Seam {
    std::string name;
    Polyline points;             ///< path from upstream to downstream [m]; empty: `depth` and `dip`
    std::optional<double> depth; ///< below the heel [m]
    double dip = 0.0;            ///< downstream [rad]
    Contact strength;            ///< friction, cohesion, residual values and table; the rest is that of [contact]
    SeamHeel heel = SeamHeel::crack;
    SeamExit exit = SeamExit::daylight;
    UpliftModel uplift = UpliftModel::linear; ///< none, linear, drains, points or seepage: along the path
    std::vector<Point> uplift_points;         ///< x = distance along the path [m], y = p / p at its entry [-]
    double dilation = 0.0;                    ///< ψ [rad]
    std::optional<double> dilation_slip;      ///< slip at which dilation ends [m]; none: never
    std::optional<SeamWedge> wedge;
    SeamInterface interface;
};

/// FE: what of the rock moves with the dam on a seam, in place of the dam on its base (with_seam_body()). Each bend of the path has
/// an upright interface to the ground; the dam stands on the first segment.
struct SeamBody {
    std::string name;
    Polyline path;                   ///< the seam, then the plane of its wedge; from upstream to downstream [m]
    std::vector<Contact> strengths;  ///< of each segment
    std::size_t of_seam = 1;         ///< segments of the seam itself, the first ones
    std::vector<Point> water;        ///< x = along the path [m], y = pressure on it [Pa]; empty: none
    std::vector<LiftJoint> interfaces; ///< the joint of the base, then one of each bend
    /// Water in the faces is hydrostatic below these levels [m]: the crack above the first point, the interfaces, the free end.
    std::optional<double> crack_level, end_level;
    std::vector<std::optional<double>> interface_levels;
};

enum class PlaneGeometry { small, linear }; ///< linear: the yield grows with the slip as the wedge is pushed up
enum class PlaneWedge { held, free };        ///< free: a wedge that slows down later than the dam runs ahead of it
enum class PlaneJudgement { factor, slip };  ///< which plane governs: least F over required, or largest slip

/// Of all planes.
struct PlaneOptions {
    PlaneGeometry geometry = PlaneGeometry::small;
    PlaneWedge wedge = PlaneWedge::held;
    PlaneJudgement governs = PlaneJudgement::slip;
    /// Name of the seam or lift that the scene slides on; empty: the base. No key: `--plane` of `sweep` and `fe` sets it.
    std::string slides_on;
};

struct RecordFiles {
    std::string name;
    std::filesystem::path horizontal; ///< resolved against the scene's folder
    std::optional<std::filesystem::path> vertical;
    std::optional<std::filesystem::path>
        other_horizontal;     ///< of the same station: measured with it, does not shake the dam
    std::string unit;         ///< of files that do not say: "g", "m/s2", "cm/s2", "gal"; empty: the file says
    std::optional<double> dt; ///< of one-column files [s]
    std::string column; ///< of `horizontal` where it holds several: heading, or number from 1; empty: the only one
    std::string vertical_column;     ///< the same of `vertical`
    std::optional<double> magnitude; ///< moment magnitude, for the regressions that ask for it [-]
    double scale = 1.0;              ///< of this pair, on top of motion.scale [-]
};

struct Motion {
    std::vector<RecordFiles> records;
    double scale = 1.0;                 ///< both components [-]
    std::optional<double> scale_to_pga; ///< horizontal peak made equal to this [m/s^2], vertical by the same factor
    std::optional<int> polarity;        ///< -1 flips the horizontal component, 1 not; none: not said, as recorded
    bool vertical = true;               ///< false: vertical components are left out
    std::vector<std::string>
        sequence;                ///< names of records that shake the same dam one after the other; empty: each alone
    double sequence_pause = 0.0; ///< at least, between two of them, on top of the run to rest [s]
};

enum class LiftOff { no_friction, ballistic };
enum class SlidingScheme { exact, slammer };

/// Weight of one empirical regression in the weighted median and band.
struct RegressionWeightKey {
    std::string model;   ///< id, as in docs/regressions.md
    double weight = 1.0; ///< relative to the others [-]
};

/// Empirical regressions of the slip.
struct RegressionOptions {
    double period = 0.0;                      ///< T_s of the sliding mass [s]; 0: rigid
    std::vector<RegressionWeightKey> weights; ///< none: all that are valid, equally
};

enum class FlexibleMethod { both, decoupled, coupled }; ///< vibration before the slip, with it, or one beside the other

/// The sliding mass as one mode on its base, beside the rigid block. Of the ways to say Gamma = L^2/(M M_1) one at most is
/// given; none: that of a uniform shear column.
struct FlexibleMass {
    std::optional<double> period;     ///< T_s of the mode on a base that does not slide [s]; none: regressions.period
    bool of_modes = false;            ///< T_s and Gamma are those of the tied FE model, water included
    double damping_ratio = 0.05;      ///< of the mode [-]
    std::optional<double> mass_ratio; ///< Gamma [-]
    std::optional<double> shape_exponent;         ///< n of psi = (y/H)^n over the section, water included [-]
    std::optional<double> modal_load, modal_mass; ///< L, M_1, water included [kg/m]
    FlexibleMethod method = FlexibleMethod::both;

    // A uniform shear column in place of the period.
    std::optional<double> height;         ///< H [m]
    std::optional<double> shear_velocity; ///< V_s at small strain [m/s]; T_s = 4 H/V_s
    std::optional<double> base_velocity;  ///< V_s of the rock below, which takes waves away [m/s]; none: it takes none
    std::optional<double> reference_strain; ///< at which the shear modulus is halved [-]; none: linear
};

/// Options of the rigid-block integration.
struct SlidingOptions {
    SlidingScheme scheme = SlidingScheme::exact;
    LiftOff lift_off = LiftOff::no_friction;
    bool two_way = true;               ///< upstream sliding allowed
    double run_out_max = 60.0;         ///< integration after the record's end at most [s]; 0: none
    std::optional<double> restitution; ///< rocking: rate after over before a landing [-]; none: by angular momentum
    double steady_rate_change = 0.1;   ///< FE: a steady rate of sliding falls by less from window to window [-]
};

enum class CombinationKind { usual, unusual, extreme, post_seismic };

/// One load combination of the limit equilibrium; what is not given is taken from the scene.
struct Combination {
    std::string name;
    CombinationKind kind = CombinationKind::usual;
    std::string follows; ///< post-seismic: the extreme combination it comes after; empty: the governing
    std::optional<double> reservoir_level; ///< [m]
    std::optional<double> tailwater_level; ///< [m]
    bool ice = false;
    bool drains_effective = true;
    bool curtain_intact = true;
    bool residual_strength = false;
    bool gates_open = false; ///< the water flows over the crest
    std::optional<CrackRule> crack;
    std::optional<double> friction;       ///< [-]
    std::optional<double> cohesion;       ///< [Pa]
    double k_h = 0.0;                     ///< seismic coefficient a_h / 9.80665, positive drives downstream [-]
    double k_v = 0.0;                     ///< a_v / 9.80665, positive up [-]
    std::vector<Point> k_profile; ///< x = above the heel [m], y = factor on k_h and k_v of inertia [-]; empty: 1
    double friction_divisor = 1.0, cohesion_divisor = 1.0; ///< partial factors of safety of mu and c [-]
    std::optional<double> pga_fraction;   ///< takes the place of k_h: share of the largest PGA of the records [-]
    std::optional<double> pga_v_fraction; ///< of k_v: share of their largest vertical acceleration, which lightens [-]
    double weight_factor = 1.0, water_factor = 1.0, uplift_factor = 1.0, silt_factor = 1.0,
           ice_factor = 1.0;                           ///< load factors [-]
    std::optional<double> required_sliding_factor;     ///< [-]
    std::optional<double> required_residual_factor;    ///< against sliding, of the residual strength [-]
    std::optional<double> required_flotation_factor;   ///< [-]
    std::optional<double> required_overturning_factor; ///< [-]
    std::optional<std::string> required_resultant;     ///< "kern", "middle-half", "base"
    std::string source;                                ///< document the required values are taken from
};

struct Criteria {
    std::optional<double> allowable_slip; ///< [m]
    std::string document;                 ///< name of a shipped set of required values; empty: none. That of a user's file is merged
    std::string report_order;             ///< titles of the report's sections that come first, with commas
    double pga_fraction = 1.0;   ///< of the seismic combination that the program makes: k_h as share of the PGA [-]
    double pga_v_fraction = 0.0; ///< and k_v as share of the largest vertical acceleration, which lightens [-]
};

enum class ElementKind { q4_incompatible, q4, t3, q8, q9, t6 };

struct MeshOptions {
    std::optional<double> size;              ///< target element size in the dam [m]; default height / 40
    std::optional<double> contact_size;      ///< on the contact plane [m]; default min(size, base / 60)
    std::optional<double> rock_contact_size; ///< on the rock's side of it [m]; none: the dam's nodes, face to face
    std::optional<double> rock_size;         ///< largest in the rock [m]; default foundation depth / 8
    double growth = 1.15;                    ///< ratio of neighbouring sizes away from the contact plane [-]
    ElementKind element = ElementKind::q4_incompatible;
    std::optional<std::filesystem::path>
        file;               ///< Gmsh file in place of the program's own mesh; resolved against the scene's folder
    double file_unit = 1.0; ///< of the file's coordinates [m]
};

enum class GravityStage { dam, dam_and_rock };
enum class PorePressure { none, total, effective };

struct Stages {
    GravityStage gravity = GravityStage::dam;
    bool geostatic = false;                          ///< displacements are set to zero after the gravity stage
    PorePressure pore_pressure = PorePressure::none; ///< water in the rock: docs/seepage.md, total or effective stress
};

enum class DampingMethod { none, rayleigh, modified_rayleigh };
enum class MassDamping { total, relative, deformation_only };

struct Damping {
    DampingMethod method = DampingMethod::rayleigh;
    double ratio = 0.05;                                           ///< [-]
    int first_mode = 1, second_mode = 5;                           ///< the two modes that get the ratio; counted from 1
    std::optional<double> mass_coefficient, stiffness_coefficient; ///< a_M [1/s], b_K [s]: given directly
    MassDamping mass = MassDamping::deformation_only;
};

enum class TimeScheme {
    automatic, ///< modes where the model is linear (tied base) and they cost less, else HHT
    hht,
    newmark,
    central_difference, ///< explicit
    modal               ///< superposition of modes: linear models only
};
/// How sub-steps are chosen: all alike, corrected by runs on few modes of the dam where it can be reduced (fe2d::CorrectedRun), or
/// else halved until the slip stays; always halved; or small ones where the slip changes its course (StepControl).
enum class Stepping { automatic, uniform, adaptive };

struct TimeOptions {
    TimeScheme scheme = TimeScheme::automatic;
    double alpha = -0.05;            ///< HHT, -1/3 ... 0 [-]
    double gamma = 0.5, beta = 0.25; ///< Newmark [-]
    std::optional<double> dt;        ///< [s]; default: the record's
    Stepping stepping = Stepping::automatic;
    std::optional<int> substeps;  ///< k of FE steps dt / 2^k, 0 ... 10; none: chosen by slip_tolerance
    double slip_tolerance = 0.01; ///< error of the slip over the largest slip on the way, wanted of the time step [-]
};

enum class AnalysisPreset { none, goldgruber_2015 };

/// A preset sets defaults (apply_preset); what the file says itself wins.
struct Analysis {
    AnalysisPreset preset = AnalysisPreset::none;
};

/// A figure the scene's author knows by other means; examples are tests by these.
struct Expectation {
    std::string quantity; ///< key of a result: "yield_acceleration_m_s2"
    double value = 0.0;
    int digits = 6;     ///< significant digits that have to agree
    std::string source; ///< where the value comes from
};

/// What the title block of a report says of the work it belongs to; empty: not said. No number depends on it.
struct Project {
    std::string name, client;    ///< of the work, and for whom it is done
    std::string author, checker; ///< who made the assessment, and who has checked it
    std::string date, revision;  ///< of the report, as written
    std::string notes;
};

struct Scene {
    // Compiled once, in scene.cpp: some eighty members are copied and destroyed.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    std::filesystem::path file; ///< as the user named it
    std::string title;
    Project project;
    double gravity = 9.81;          ///< in loads [m/s^2]
    std::optional<RockWedge> wedge; ///< instead of section, dam, contact and all that belongs to them
    Section section;
    Material dam;
    Contact contact;
    std::vector<LiftJoint> lift_joints; ///< from the bottom up
    std::vector<LiftJoint> tied_lifts; ///< FE: lines of the mesh that do not part, whose strength is watched; the same order
    std::optional<Lifts> lifts;
    std::vector<Seam> seams;
    std::optional<SeamBody> seam_body; ///< FE: the body that slides; none: the dam on its base
    PlaneOptions planes;
    std::vector<Anchor> anchors;
    std::optional<Foundation> foundation;
    std::optional<Curtain> curtain;
    std::optional<Reservoir> reservoir;
    std::optional<Gate> gate;
    AddedMass added_mass; ///< used when the reservoir moves as added mass
    std::optional<Tailwater> tailwater;
    std::optional<Silt> silt;
    std::optional<Ice> ice;
    std::vector<PointForce> forces;
    std::optional<Uplift> uplift;
    std::optional<Drains> drains;
    Motion motion;
    SlidingOptions sliding;
    RegressionOptions regressions;
    std::optional<FlexibleMass> flexible_block;
    std::vector<Combination> combinations; ///< empty: usual, seismic and post-seismic made from the scene
    Criteria criteria;
    MeshOptions mesh;
    Stages stages;
    Damping damping;
    TimeOptions time;
    Analysis analysis;
    std::vector<Expectation> expectations;
    std::vector<Diagnostic> notes; ///< values that are allowed but not those of real dams (plausible.hpp)
};

} // namespace damslip
