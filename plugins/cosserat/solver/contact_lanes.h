#pragma once

#include <cstdint>
#include <span>

#include "plugins/cosserat/lanes/diagonal_blocks.h"
#include "plugins/cosserat/lanes/lanes.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// Eight contacts side by side, as lanes.h has elements; their mathematics is that of ContactTerms.
/// Lanes without a contact are those of empty_contact_row().
struct alignas(64) ContactRow {
  // As found (ContactPoint), the plane following the plant where it touches itself.
  std::int64_t element[lane_count];
  Lanes back, radius;                     // m
  Lanes normal[3];                        // unit, W
  Lanes gap, margin;                      // m
  Lanes surface_motion[3];                // m, W
  Lanes spring_stiffness, spring_margin;  // N/m, m: ContactPoint::Stiffening
  Lanes stiffness;                        // N/m, of contact and collider in series
  // Of the step before.
  Lanes stretch[3];  // m, W, of the friction spring at the step's start
  Lanes limit;       // N, mu N
  // At the iterate.
  Lanes arm[3];              // m, E, from the child node to the touching surface
  Lanes place[3];            // m, W
  Lanes start[3];            // m, W, where that point of the plant began the step
  Lanes energy;              // J
  int collider[lane_count];  // as found; last, since vectors are loaded from whole lines
};

/// Neither pushes nor rubs.
ContactRow empty_contact_row();

/// What eight contacts carry at a step's end.
struct alignas(64) ContactEndRow {
  Lanes place[3];     // m, W
  Lanes normal;       // N, >= 0
  Lanes friction[3];  // N, W, on the plant
  Lanes stretch[3];   // m, W, of the friction spring after sliding
  Lanes slipping;     // 1 or 0
};

/// All of these take contacts of one plant, eight at a time on the widest vectors that the
/// processor has. The two sides of a self-contact stand in lanes 2 i and 2 i + 1 of a row.

/// Sets arm, place and start of contacts just found.
void place_contacts(std::span<ContactRow> rows, const RodState& start, const RodState& iterate);
/// Sets the energy at the iterate where place was taken, and the blocks and their elements, eight a
/// row: -1 where a contact neither pushes nor rubs. Returns whether each block has the element that
/// it had before.
bool push_contacts(std::span<ContactRow> rows, const RodState& iterate, int* elements,
                   ElementBlock* blocks);
/// Takes self-contacts along to another iterate: normals and arms stay, the plane between two sides
/// goes along with the middle of both, and the spring gets the tangent there.
void follow_contacts(std::span<ContactRow> rows, const RodState& iterate);
/// J, of all the rows at a state.
double potential_of_contacts(std::span<const ContactRow> rows, const RodState& state);
/// What they carry at the end of a step, one row of `ends` each. The first `sides` contacts, none
/// where it is negative, are sides of self-contacts: two meet in the middle of where both went
/// since the last iterate.
void end_contacts(std::span<ContactRow> rows, int sides, const RodState& end, ContactEndRow* ends);

}  // namespace pedicel::cosserat
