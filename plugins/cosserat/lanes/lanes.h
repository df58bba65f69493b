#pragma once

#include "plugins/cosserat/lanes/fetch_ahead.h"
#include "plugins/cosserat/laws/joint_terms.h"

namespace pedicel::cosserat {

class LoopShape;

/// Structure of arrays for the direct solver: a row holds eight elements side by side, one a lane,
/// and the kernels of lane_kernels.h work on whole rows. Which element stands where: lane_layout.h.
/// A number of a row is a `Lanes`; a vector quantity is one `Lanes` a component.
inline constexpr int lane_count = 8;
using Lanes = double[lane_count];

/// Constants of eight elements (RodModel's Element; SI units, E unless said).
struct alignas(64) ElementRow {
  Lanes length, stretch_stiffness[3], bend_stiffness[3], rest_strain[3], rest_rotation[4];
  Lanes mass, com_back, inertia[3], damping_time, mass_damping;
  Lanes alive;  // 1, or 0 where there is no element (any more): its unknowns stay as they are
};

/// Where eight elements are: child nodes (m, W) and orientations (x, y, z, w; E to W).
struct alignas(64) PoseRow {
  Lanes position[3], orientation[4];
};

/// What else the scheme knows of a time: velocity of the centre of mass (m/s, W), angular velocity
/// (rad/s, E).
struct alignas(64) RateRow {
  Lanes velocity[3], angular_velocity[3];
};

/// Strains from rest (1 and rad, E), where there is Kelvin-Voigt damping or a joint law.
struct alignas(64) StrainRow {
  Lanes stretch[3], bend[3];
};

/// The terms of one step's incremental potential (plugins/cosserat/README.md). With h~ = beta dt
/// (beta 1 for backward Euler, 2/3 for BDF2) and starred values the scheme's combination of the
/// past, inertia, Kelvin-Voigt damping (dissipation K tau |strain - strain*|^2 / (2 h~)) and mass
/// damping all fold into springs towards a target:
///   inertia  1/2 mass/h~^2 (1 + rate h~) |c - c_target|^2   c_target = c* + h~ v* / (1 + rate h~)
///   rods     1/2 K (1 + tau/h~) |strain - strain_target|^2  strain_target = strain* tau / (h~+tau)
struct alignas(64) TermRow {
  Lanes com_target[3], rotation_target[4];  // m, W; E to W
  Lanes inertia_scale;                      // 1/s2: (1 + rate h~)/h~^2
};

/// Those of Kelvin-Voigt damping: without it they are 0, 0 and 1.
struct alignas(64) ViscousRow {
  Lanes stretch_target[3], bend_target[3];  // 1 and rad, E
  Lanes stiffening;                         // 1: 1 + tau/h~
};

/// Constants of eight elements' extensions (JointLaw, SegmentAir; SI units). Where an element has
/// none, they add exact zeros to what ElementRow says.
struct alignas(64) ExtensionRow {
  Lanes lawful;                     // 1 where the joint has a law
  Lanes bend_excess, twist_excess;  // 1, elastic + deviation - 1 (twist: with the sliders' shares)
  Lanes elastic;                    // 1
  Lanes drag;                       // N/(m/s)2, 1/2 rho drag_area length
  Lanes velocity[3], gust[3];       // m/s, W
  Lanes plate_normal, plate_tangential;  // N/(m/s)2, as drag
  Lanes plate[3];                        // E, the plate's normal; 0: there is none
};

/// Numbers of eight joints' terms (JointLaw::terms).
struct alignas(64) JointTermRow {
  Lanes number[laws::joint_term_numbers];
};

/// One branch of eight joints (JointBranch). Over a step during which phi changes evenly
///   phi - z_{n+1} = factor phi_{n+1} - decay z_n - (factor - decay) phi_n
/// exactly, with decay = exp(-dt/time), factor = (1 - decay) time/dt.
struct alignas(64) BranchRow {
  Lanes share, decay, factor;
  Lanes limit;     // N m; infinite: no slider
  Lanes exponent;  // 1, of a slider that gives way little by little; 0: all at once
  Lanes value[3];  // rad, z at the step's start; after finish() at its end
};

/// The extensions' terms of one step.
struct alignas(64) ExtensionTermRow {
  Lanes
      bend_stiffness[3];  // N m/rad: what is linear in phi (its offset is ViscousRow::bend_target)
  Lanes bias[3];          // rad, RodState::joint_bias
  Lanes middle_past[3];   // m, W: c* of the segment's middle
  Lanes air[3];           // m/s, W, at the step's end
  Lanes axis[3];          // W, of the segment where the drag was linearised last
  Lanes plate[3];         // W, the plate's normal there
};

/// The blocks of Newton's system. An element's unknowns are its position x (m, W) and its rotation
/// vector r (rad, W), which are the rows and columns of its 6x6 blocks:
///
///                  diagonal block                coupling block
///                  own x    own r                parent x  parent r
///       own x x  [ lower          ]     own x x  [ full      0      ]
///             y  [ triangle       ]           y  [ full      0      ]
///             z  [                ]           z  [ full      0      ]
///       own r x  [ full    lower  ]     own r x  [ full      full   ]
///             y  [ full    triangle]          y  [ full      full   ]
///             z  [ full           ]           z  [ full      full   ]
///
/// Stretch couples own x and own r with parent x. Bend couples own r with parent r, and nothing
/// couples own x with parent r. The diagonal block is symmetric: of its 36 numbers the 21 of the
/// lower triangle are kept, by rows. The right side follows: 6 numbers, x and then r.
inline constexpr int triangle6 = 21, block_size = triangle6 + 6;

/// The factors of eight elements' blocks, L D L^T the diagonal block, L with ones on its diagonal.
/// In single precision, which halves what has to come from memory: Newton's change is off by some
/// 1e-7 of itself, which its next iteration finds, and y, which the equilibrium of forces hangs on,
/// is not rounded.
struct alignas(64) FactorRow {
  static constexpr int lower_size = triangle6 - 6, coupling_size = 27;
  /// First W = -D^-1 L^-1 coupling by columns (its upper right quarter is zero), then L's lower
  /// triangle by rows. The line search needs neither: the iterate that it begins from stands there.
  union {
    float factors[coupling_size + lower_size][lane_count];
    PoseRow base;
  };
  Lanes right[6];  ///< y = D^-1 L^-1 right side, and then the solution
};

/// The blocks of eight elements of plants with loops, which are not eliminated in rows.
struct alignas(64) BlocksRow {
  Lanes diagonal[triangle6];
  Lanes coupling[21];  ///< minus it: two symmetric quarters with the lower left one between them
  Lanes right[6];      ///< right side
  Lanes on_parent[6];  ///< what the parent's gets
};

/// Constants of eight welds (Weld; SI units). Where there is none, they are zero.
struct alignas(64) WeldRow {
  Lanes position_stiffness, bend_stiffness[3], rest_rotation[4];
};

/// W = D^-1 L^-1 coupling of one entry of the factor of eight loop parts, by columns.
struct alignas(64) LoopFactorRow {
  float values[36][lane_count];
};

/// What goes into one element's block from outside its row: a branch that starts at it, or springs
/// and contacts. `values` are block_size numbers, `stride` apart.
struct BlockSource {
  const double* values = nullptr;
  int stride = 1;
  int lane = 0;
  int next = -1;  // index of the next source of the same row
};

/// Chains of elements, up to one a lane, whose rows follow each other:
///
///                  lane 0      lane 1      lane 2     ...  lane 7
///     begin        parent of   parent of   clamp of        -        no elements: poses, changes
///                  A 1         B 1         stem C
///     begin + 1    branch A 1  branch B 1  stem C 1        -          parent of a row:
///     begin + 2    branch A 2  branch B 2  stem C 2        -        | the row above,
///     begin + 3    branch A 3  branch B 3  -               -        v same lane
///     end          (row `begin` of the next pack)
///
/// Kernels go down or up these rows, with all eight lanes in one vector. A lane that is shorter
/// than the pack, or empty, computes along without effect (ElementRow::alive).
///
/// A pack of loop parts has in each lane the elements of one, and row `begin` what carries them.
struct alignas(64) Pack {
  // How each lane's plant steps. x' = (x - (past_now x_n - past_before x_{n-1})) / effective_step.
  Lanes past_now, past_before, effective_step;
  Lanes accelerate;  // s: dt where Newton's first guess continues the acceleration too, else 0
  Lanes share;       // 1, of Newton's change that is applied; 0: the lane stays as it is
  // Extensions at the step's end: stiffness_factor(), sin(2 pi gust_frequency t).
  Lanes modulus, gust_now;  // 1
  // Results.
  Lanes energy_before;        // J, at the iterate that Newton's system was made at
  Lanes energy;               // J, where the move from there led
  Lanes turn, shift, change;  // largest: rad; element lengths; m or rad
  Lanes healthy;              // 1 where all pivots were positive
  Lanes branch[block_size];   // what the first elements give to their parents' blocks
  int begin = 0, end = 0;
  bool active = true;     // some plant in it is still being solved
  bool anchored = false;  // row `begin` holds the parents' iterate
  bool viscous = false;   // some element has Kelvin-Voigt damping, or an extension
  // Extensions.
  bool extended = false, windy = false;  // some plant in it has any; drag
  bool plated = false;                   // drag of plates
  unsigned terms = 0;                    // JointTerm::bit of those that some joint in it has
  int branches = 0, sliders = 0;         // of its joints at most
  bool hysteretic = false;               // some slider in it gives way little by little
  // Loop parts, one a lane: rows have the parents that the shape says. nullptr: the row above.
  const LoopShape* loops = nullptr;
  int first_weld = 0, first_loop_factor = 0;  // their rows
};

/// Where the rows are; indices are rows.
struct RowArrays {
  const ElementRow* element = nullptr;
  PoseRow *start = nullptr, *iterate = nullptr;
  /// One step before the start; from prepare() on c* and q* stand there, which it went into.
  PoseRow* previous = nullptr;
  RateRow* rate = nullptr;
  const RateRow* previous_rate = nullptr;
  StrainRow* strain = nullptr;  // this and the next two where some plant needs them
  const StrainRow* previous_strain = nullptr;
  ViscousRow* viscous = nullptr;
  TermRow* term = nullptr;
  FactorRow* factor = nullptr;
  BlocksRow* blocks = nullptr;        // where some plant has loops
  const int* first_branch = nullptr;  // a row, into `branches`; -1: none
  const int* first_extra = nullptr;   // a row, into `extras`; -1: none
  const BlockSource* branches = nullptr;
  const BlockSource* extras = nullptr;
  const ExtensionRow* extension = nullptr;
  ExtensionTermRow* extension_term = nullptr;
  const JointTermRow* joint_term = nullptr;  // where some plant has any
  const WeldRow* weld = nullptr;             // of loop parts
  LoopFactorRow* loop_factor = nullptr;
  BranchRow* law_branch = nullptr;  // `law_branches` a row
  int law_branches = 0;
  double axis_share = 1.0;              // 1, by which ExtensionTermRow::axis follows the iterate
  double gravity[3] = {0.0, 0.0, 0.0};  // m/s2, W
  FetchAhead* ahead = nullptr;          // where there is something to fetch meanwhile
};

}  // namespace pedicel::cosserat
