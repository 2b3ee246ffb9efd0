#pragma once

#include <cstddef>
#include <cstdint>

#include "grains/contact_law.h"
#include "suffuse/simd/instruction_set.h"

namespace suffuse::grains {

/// Three components and a fourth value that belongs to them.
struct alignas(32) Quad {
  double x = 0, y = 0, z = 0, w = 0;
};

/// Force (N) and torque (N m) on a grain; w is not used.
struct Load {
  Quad force, torque;
};

/// Owned grains first, then copies of other grains (ghosts).
struct GrainArrays {
  const Quad* position;  ///< m; w: radius
  const Quad* velocity;  ///< m/s; w: 1 / mass (1/kg), next to nothing for a grain that contacts cannot move
  const Quad* spin;      ///< rad/s; w: radius
  const int* material;   ///< 0 based; null if there is one material
};

/// Pairs that may touch until the next list. Pair k is first[k] at position[first[k]] with second[k] at
/// position[second[k]]; the second one's motion is that of velocity[motion[k]] (a periodic image moves as its
/// original does), and what acts on it is added to loads[receiver[k]]. Its spring is the k-th.
struct CandidatePairs {
  std::size_t count;
  const int* first;
  const int* second;
  const int* motion;
  const int* receiver;
};

/// One evaluation of all contacts.
struct PassSettings {
  ContactLaw law;
  double time_step = 0;
  bool advance_springs = true;  ///< false: forces of the springs as they are (set-up, samples)
  bool half_step_normal =
      false;  ///< velocities are those of half a step ago: so is the normal they are split with
  bool drop_lost_springs =
      true;                ///< a pair that did not touch in the pass before starts with a spring of zero
  double pass_number = 1;  ///< of the passes that advance springs; w of a spring is the last it took part in
};

/// What a contact was found to do, where a caller wants to know each one.
struct ContactNote {
  std::uint32_t pair;  ///< index of the candidate
  double force[3];     ///< on the first grain
  double torque[3];    ///< on the first grain
  double torque_on_second[3];
};

/// What a pass adds to or writes; null pointers where nothing is wanted.
struct PassOutput {
  Load* loads = nullptr;
  double* virial = nullptr;        ///< six sums xx yy zz xy xz yz of branch times force (J), added to
  double* grain_virial = nullptr;  ///< six a grain: half of each contact's on both sides
  int owned = 0;                   ///< receivers >= owned count for half of a contact's virial
  void (*note)(void* listener,
               const ContactNote&) = nullptr;  ///< told of every contact, in the order of pairs
  void* listener = nullptr;
};

/// Forces of all touching candidates. Touching means distance < sum of radii. Springs (m, on the first
/// grain's side) are advanced in place if the settings say so. Returns how many touch.
///
/// `instruction_set` chooses among versions that differ by rounding only.
std::size_t contact_pass(InstructionSet instruction_set, const CandidatePairs& candidates,
                         const GrainArrays& grains, const PassSettings& settings, Quad* springs,
                         const PassOutput& output);

/// As `contact_pass`, one contact after the other in plain code: what the fast versions are held against.
std::size_t reference_contact_pass(const CandidatePairs& candidates, const GrainArrays& grains,
                                   const PassSettings& settings, Quad* springs, const PassOutput& output);

}  // namespace suffuse::grains
