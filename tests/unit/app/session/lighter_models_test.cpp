#include "app/session/lighter_models.h"

#include <gtest/gtest.h>

#include "tests/support/colored_sphere.h"

namespace flytri::session {
namespace {

using reconstruct::MeshDensity;

TEST(LighterModels, EachIsMadeOnceWhenItIsAskedFor) {
  reconstruct::FinishedScan scan;
  scan.model = textured_sphere();
  LighterModels lighter(std::make_shared<const reconstruct::FinishedScan>(std::move(scan)));
  EXPECT_EQ(lighter.made(MeshDensity::kCad), nullptr);
  const auto cad = lighter.get(MeshDensity::kCad);
  ASSERT_TRUE(cad);
  EXPECT_EQ(lighter.made(MeshDensity::kCad), *cad);
  EXPECT_EQ(lighter.get(MeshDensity::kCad).value(), *cad);
  EXPECT_EQ(lighter.made(MeshDensity::kLight), nullptr);
}

TEST(LighterModels, WhatWasCanceledIsMadeAnotherTime) {
  reconstruct::FinishedScan scan;
  scan.model = textured_sphere();
  LighterModels lighter(std::make_shared<const reconstruct::FinishedScan>(std::move(scan)));
  Progress canceled;
  canceled.cancel();
  EXPECT_EQ(lighter.get(MeshDensity::kLight, canceled).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(lighter.made(MeshDensity::kLight), nullptr);
  EXPECT_TRUE(lighter.get(MeshDensity::kLight));
}

}  // namespace
}  // namespace flytri::session
