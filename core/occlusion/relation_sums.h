/// @file  Normal equations of the relation of two jaws, from points of bite scans.
#pragma once

#include "core/geometry/decompositions.h"

namespace flytri::occlusion {

/// The equations of the relation alone, after the places of the bite scans are eliminated.
struct ReducedRelation {
  Matrix6 matrix = Matrix6::Zero();
  Twist gradient = Twist::Zero();

  ReducedRelation& operator+=(const ReducedRelation& other) {
    matrix += other.matrix;
    gradient += other.gradient;
    return *this;
  }
  ReducedRelation& operator-=(const ReducedRelation& other) {
    matrix -= other.matrix;
    gradient -= other.gradient;
    return *this;
  }
  /// The motion of the lower jaw.
  [[nodiscard]] Twist solve() const { return solve_symmetric(matrix, -gradient); }
};

/// Sums over points of one bite scan. Unknown are two small motions about one center: of the lower
/// jaw and of the bite scan.
class RelationSums {
 public:
  /// How an offset changes with each motion.
  struct Rows {
    Twist lower = Twist::Zero(), bite = Twist::Zero();
  };
  void add(const Rows& rows, double offset_mm, double weight) {
    LL_ += weight * rows.lower * rows.lower.transpose();
    LB_ += weight * rows.lower * rows.bite.transpose();
    BB_ += weight * rows.bite * rows.bite.transpose();
    Lr_ += weight * offset_mm * rows.lower;
    Br_ += weight * offset_mm * rows.bite;
  }
  [[nodiscard]] RelationSums operator-(const RelationSums& other) const {
    RelationSums rest = *this;
    rest.LL_ -= other.LL_;
    rest.LB_ -= other.LB_;
    rest.BB_ -= other.BB_;
    rest.Lr_ -= other.Lr_;
    rest.Br_ -= other.Br_;
    return rest;
  }
  [[nodiscard]] ReducedRelation reduced() const {
    const Matrix6 share = LB_ * inverse_of_symmetric(BB_);
    return {LL_ - share * LB_.transpose(), Lr_ - share * Br_};
  }
  /// The motion of the bite scan that goes with one of the lower jaw.
  [[nodiscard]] Twist solve_bite(const Twist& lower) const {
    return solve_symmetric(BB_, -(Br_ + LB_.transpose() * lower));
  }

 private:
  Matrix6 LL_ = Matrix6::Zero(), LB_ = Matrix6::Zero(), BB_ = Matrix6::Zero();
  Twist Lr_ = Twist::Zero(), Br_ = Twist::Zero();
};

}  // namespace flytri::occlusion
