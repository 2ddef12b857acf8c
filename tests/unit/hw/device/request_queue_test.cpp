#include "hw/device/request_queue.h"

#include <gtest/gtest.h>

namespace flytri::device {
namespace {

TEST(RequestQueue, ReturnsOnlyTheLastDueRequest) {
  RequestQueue queue;
  EXPECT_FALSE(queue.first_due_s());
  EXPECT_EQ(queue.post({Light::kVertical, 1.0}), 1);
  EXPECT_EQ(queue.post({Light::kHorizontal, 2.0}), 2);
  EXPECT_EQ(queue.post({Light::kFlash, 3.0}), 3);
  EXPECT_EQ(queue.first_due_s(), 1.0);
  EXPECT_FALSE(queue.take_due(0.5));
  const auto due = queue.take_due(2.0);
  ASSERT_TRUE(due);
  EXPECT_EQ(due->request.number, 2);
  EXPECT_EQ(due->request.request.light, Light::kHorizontal);
  EXPECT_EQ(due->skipped, 1);
  EXPECT_FALSE(queue.take_due(2.9));
  EXPECT_EQ(queue.take_due(3.0)->skipped, 0);
  EXPECT_FALSE(queue.is_due(9.0));
}

// Requests keep the order of posting: a due request waits for an earlier one that is not due yet.
TEST(RequestQueue, KeepsTheOrderOfPosting) {
  RequestQueue queue;
  queue.post({Light::kVertical, 5.0});
  queue.post({Light::kDark, 0.0});
  EXPECT_FALSE(queue.take_due(1.0));
  EXPECT_EQ(queue.take_due(5.0)->request.request.light, Light::kDark);
}

TEST(RequestQueue, ClearResetsTheNumbers) {
  RequestQueue queue;
  queue.post({Light::kVertical, 5.0});
  queue.clear();
  EXPECT_FALSE(queue.is_due(9.0));
  EXPECT_EQ(queue.post({Light::kDark, 0.0}), 1);
}

}  // namespace
}  // namespace flytri::device
