/// @file  Dimensions of the teeth of both jaws, with the rim points of their chewing surfaces.
#include "assets/sample_jaw/tooth.h"

namespace flytri::sample_jaw {
namespace {

// A rim runs around the chewing surface: along the outer face from mesial to distal, then back
// along the inner face.
using Rim = std::vector<RimPoint>;

Rim upper_premolar_rim() {
  return {{{0.00, 0.56}, 0.0, true}, {{-0.55, 0.36}, 1.1},       {{-0.66, 0.0}, 1.7},
          {{-0.50, -0.36}, 1.6},     {{0.08, -0.54}, 0.8, true}, {{0.55, -0.36}, 1.6},
          {{0.66, 0.0}, 1.7},        {{0.55, 0.36}, 1.1}};
}

Rim lower_first_premolar_rim() {
  return {{{0.05, 0.30}, 0.0, true}, {{-0.58, 0.15}, 1.5},       {{-0.62, -0.2}, 2.2},
          {{-0.35, -0.5}, 2.7},      {{0.05, -0.56}, 2.3, true}, {{0.4, -0.48}, 2.8},
          {{0.62, -0.2}, 2.3},       {{0.58, 0.15}, 1.6}};
}

Rim lower_second_premolar_rim() {
  return {{{0.0, 0.46}, 0.0, true},    {{-0.6, 0.28}, 1.1},   {{-0.66, -0.1}, 1.7},
          {{-0.42, -0.52}, 1.2, true}, {{-0.12, -0.58}, 1.7}, {{0.30, -0.54}, 0.7, true},
          {{0.66, -0.1}, 1.6},         {{0.6, 0.28}, 1.1}};
}

Rim upper_first_molar_rim() {
  return {{{0.46, 0.58}, 0.2, true},  {{0.02, 0.58}, 1.2},         {{-0.42, 0.54}, 0.5, true},
          {{-0.70, 0.1}, 1.6},        {{-0.52, -0.52}, 1.1, true}, {{-0.16, -0.60}, 1.7},
          {{0.34, -0.50}, 0.0, true}, {{0.68, -0.05}, 1.5}};
}

Rim upper_second_molar_rim() {
  return {{{0.46, 0.56}, 0.1, true},  {{0.02, 0.56}, 1.2},         {{-0.40, 0.50}, 0.8, true},
          {{-0.68, 0.1}, 1.7},        {{-0.48, -0.46}, 1.6, true}, {{-0.2, -0.56}, 1.9},
          {{0.30, -0.52}, 0.0, true}, {{0.68, -0.05}, 1.5}};
}

Rim lower_first_molar_rim() {
  return {{{0.52, 0.52}, 0.3, true},   {{0.24, 0.56}, 1.1},        {{-0.10, 0.54}, 0.5, true},
          {{-0.38, 0.50}, 1.2},        {{-0.60, 0.30}, 0.9, true}, {{-0.72, -0.1}, 1.7},
          {{-0.42, -0.56}, 0.2, true}, {{0.02, -0.58}, 1.2},       {{0.44, -0.56}, 0.0, true},
          {{0.72, 0.0}, 1.5}};
}

Rim lower_second_molar_rim() {
  return {{{0.46, 0.54}, 0.2, true},  {{0.0, 0.56}, 1.2},          {{-0.44, 0.52}, 0.5, true},
          {{-0.70, 0.0}, 1.6},        {{-0.44, -0.56}, 0.4, true}, {{0.0, -0.58}, 1.3},
          {{0.44, -0.56}, 0.0, true}, {{0.70, 0.0}, 1.5}};
}

}  // namespace

std::vector<ToothForm> upper_teeth() {
  return {{"central incisor", 8.6, 7.2, 10.2, 0.22, {}, 0.05},
          {"lateral incisor", 6.7, 6.2, 9.2, 0.20, {}, 0.25},
          {"canine", 7.7, 8.2, 10.4, 0.12, {}, 1.9},
          {"first premolar", 7.1, 9.2, 8.4, 0.06, upper_premolar_rim(), 0.0},
          {"second premolar", 6.8, 9.0, 7.8, 0.04, upper_premolar_rim(), 0.0},
          {"first molar", 10.4, 11.3, 7.4, 0.06, upper_first_molar_rim(), 0.0},
          {"second molar", 9.8, 11.2, 7.0, 0.10, upper_second_molar_rim(), 0.0}};
}

std::vector<ToothForm> lower_teeth() {
  return {{"central incisor", 5.5, 6.0, 8.9, 0.14, {}, 0.05},
          {"lateral incisor", 6.0, 6.4, 9.2, 0.12, {}, 0.12},
          {"canine", 7.0, 7.8, 10.6, 0.05, {}, 1.6},
          {"first premolar", 7.1, 7.9, 8.7, -0.04, lower_first_premolar_rim(), 0.0},
          {"second premolar", 7.3, 8.3, 8.0, -0.10, lower_second_premolar_rim(), 0.0},
          {"first molar", 11.3, 10.5, 7.5, -0.18, lower_first_molar_rim(), 0.0},
          {"second molar", 10.6, 10.2, 7.0, -0.24, lower_second_molar_rim(), 0.0}};
}

}  // namespace flytri::sample_jaw
