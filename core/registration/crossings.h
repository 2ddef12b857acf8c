/// @file  Corresponding points of a view and a metaview: where their profiles cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/registration/closest_pair.h"

namespace flytri::registration {

/// Views that behave like one rigid view, all in one frame (paper: metaview U).
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
  Vec3 normal;             ///< of the surface: o_k x o_l, unit, of either sign
  double distance_mm = 0;  ///< of p above q along the normal
  double sigma_mm = 0;     ///< standard uncertainty of that distance by the noise of both points
  double depth_variation_mm = 0;  ///< sum over both profiles: the paper's weight
};

/// Which places count as crossings.
struct CrossingLimits {
  double max_distance_mm = 0;  ///< d_max: farther apart, the profiles do not cross on the surface
  /// Default 0.35, range (0, 1). Sine of the angle between the profiles: nearly parallel ones give
  /// no normal, and their closest points wander.
  double min_crossing_sine = 0.35;
  /// Default 0.35, range (0, 1). Sine of the angle between the light sheets. In one sheet any two
  /// curves meet somewhere: their meeting says nothing of the surface, and draws every view onto an
  /// earlier one whose lines ran the same way.
  double min_sheet_sine = 0.35;
  /// Default 0.15, range [0, 1). Sine of the angle between a measurement ray and the surface: a
  /// surface seen more edge-on would not have been measured.
  double min_ray_sine = 0.15;
};

/// All pairs that may cross within the limits by their boxes and light sheets, by (k, view, l).
[[nodiscard]] std::vector<ProfilePair> candidate_pairs(const PreparedView& source,
                                                       Metaview metaview,
                                                       const CrossingLimits& limits);

/// Puts a random choice of `count` pairs at the front, the rest behind.
void shuffle_front(std::vector<ProfilePair>& pairs, std::size_t count, Random& random);

/// Searches the crossing of every pair and keeps those within the limits.
/// @param source  in the metaview's frame.
[[nodiscard]] std::vector<Crossing> find_crossings(const PreparedView& source, Metaview metaview,
                                                   std::span<const ProfilePair> pairs,
                                                   const CrossingLimits& limits);

/// Follows crossings after the source was moved a little: a local search from where they were.
/// Those that left the limits are dropped.
/// @param T_moved  from where find_crossings() saw the source to where it is now.
[[nodiscard]] std::vector<Crossing> follow_crossings(const PreparedView& source, Metaview metaview,
                                                     const Isometry& T_moved,
                                                     std::span<const Crossing> crossings,
                                                     const CrossingLimits& limits);

}  // namespace flytri::registration
