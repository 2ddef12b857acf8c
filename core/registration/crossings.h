/// @file  Corresponding points of a view and a metaview: the places where their profiles cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/registration/closest_pair.h"

namespace flytri::registration {

/// Views in one frame that act as one rigid view (paper: metaview U).
using Metaview = std::span<const PreparedView* const>;

/// A profile of the source and one of the metaview that may cross.
struct ProfilePair {
  std::uint32_t k = 0;     ///< position in the source's profiles
  std::uint32_t view = 0;  ///< position in the metaview
  std::uint32_t l = 0;     ///< position in that view's profiles
};

/// A pair of corresponding points (paper: p_kl, q_kl), in the metaview's frame.
struct Crossing {
  ProfilePair pair;
  double x = 0, y = 0;     ///< places on the source's and the metaview's curve
  Vec3 p_mm;               ///< on the source
  Vec3 q_mm;               ///< on the metaview
  Vec3 normal;             ///< surface normal o_k x o_l, unit, sign undefined
  double distance_mm = 0;  ///< signed, of p from q along the normal
  double sigma_mm = 0;     ///< standard uncertainty of that distance from the noise of both points
  double depth_variation_mm = 0;  ///< sum over both profiles: the paper's weight
};

/// Limits for crossings.
struct CrossingLimits {
  double max_distance_mm = 0;  ///< d_max: larger distances are not crossings
  /// Default 0.35, range (0, 1). Sine of the angle between the profiles: nearly parallel profiles
  /// give no normal, and their closest points are unreliable.
  double min_crossing_sine = 0.35;
  /// Default 0.35, range (0, 1). Sine of the angle between the light sheets. Two curves in the same
  /// light sheet always meet somewhere, independent of the surface. Such crossings would pull a
  /// view onto an earlier view with the same line direction.
  double min_sheet_sine = 0.35;
  /// Default 0.15, range [0, 1). Sine of the angle between a measurement ray and the surface: a
  /// surface at a smaller angle would not have been measured.
  double min_ray_sine = 0.15;
};

/// All pairs that may cross within the limits, judged by their boxes and light sheets. Sorted by
/// (k, view, l).
[[nodiscard]] std::vector<ProfilePair> candidate_pairs(const PreparedView& source,
                                                       Metaview metaview,
                                                       const CrossingLimits& limits);

/// Moves `count` randomly chosen pairs to the front.
void shuffle_front(std::vector<ProfilePair>& pairs, std::size_t count, Random& random);

/// Searches the crossing of each pair. Returns those within the limits.
/// @param source  in the metaview's frame.
[[nodiscard]] std::vector<Crossing> find_crossings(const PreparedView& source, Metaview metaview,
                                                   std::span<const ProfilePair> pairs,
                                                   const CrossingLimits& limits);

/// Updates crossings after a small motion of the source, by a local search from their last places.
/// Crossings outside the limits are dropped.
/// @param T_moved  motion of the source since find_crossings().
[[nodiscard]] std::vector<Crossing> follow_crossings(const PreparedView& source, Metaview metaview,
                                                     const Isometry& T_moved,
                                                     std::span<const Crossing> crossings,
                                                     const CrossingLimits& limits);

}  // namespace flytri::registration
