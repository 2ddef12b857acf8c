#include "hw/simulated/optics/ray_scene.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "hw/simulated/optics/embree.h"

namespace flytri::simulated {
namespace {

constexpr std::size_t kPacket = 8;
constexpr float kFar = std::numeric_limits<float>::infinity();

// Shadow rays start this share of the mesh's extent above their surface: some tens of float steps.
constexpr double kLift = 3e-6;

struct EmbreeDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeDeleter>;
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeDeleter>;

double extent_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const SurfacePoint& vertex : mesh.vertices) box.extend(vertex.position_mm);
  return box.isEmpty()
             ? 0.0
             : static_cast<double>(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm());
}

void attach_mesh(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    Eigen::Map<Vec3f>(positions + 3 * i) = mesh.vertices[i].position_mm;
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), indices + 3 * i);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RayHit make_hit(const TriangleMesh& mesh, std::uint32_t triangle, double u, double v) {
  const Triangle& corners = mesh.triangles[triangle];
  const Vec3 a = mesh.vertices[corners[0]].position_mm.cast<double>();
  const Vec3 b = mesh.vertices[corners[1]].position_mm.cast<double>();
  const Vec3 c = mesh.vertices[corners[2]].position_mm.cast<double>();
  RayHit hit;
  hit.weights = {1.0 - u - v, u, v};
  hit.point_mm = hit.weights[0] * a + u * b + v * c;
  hit.normal = (b - a).cross(c - a).normalized();
  hit.triangle = triangle;
  return hit;
}

}  // namespace

struct RayScene::Embree {
  TriangleMesh mesh;
  double lift_mm = 0.0;
  DevicePtr device;
  ScenePtr scene;
};

RayScene::RayScene(const TriangleMesh& mesh) {
  auto embree = std::make_shared<Embree>();
  embree->mesh = mesh;
  embree->lift_mm = kLift * extent_of(mesh);
  embree->device.reset(rtcNewDevice(nullptr));
  embree->scene.reset(rtcNewScene(embree->device.get()));
  rtcSetSceneFlags(embree->scene.get(), RTC_SCENE_FLAG_ROBUST);
  attach_mesh(embree->device.get(), embree->scene.get(), embree->mesh);
  rtcCommitScene(embree->scene.get());
  embree_ = std::move(embree);
}

const TriangleMesh& RayScene::mesh() const { return embree_->mesh; }

std::optional<RayHit> RayScene::first_hit(const Ray& ray) const {
  RTCRayHit query{};
  const Vec3f origin = ray.origin_mm.cast<float>();
  const Vec3f direction = ray.direction.cast<float>();
  query.ray = {
      origin.x(), origin.y(), origin.z(), 0.0F, direction.x(), direction.y(), direction.z(), 0.0F,
      kFar,       ~0U,        0,          0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  find_hit(embree_->scene.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return make_hit(embree_->mesh, query.hit.primID, query.hit.u, query.hit.v);
}

void RayScene::first_hits(std::span<const Ray> rays, std::span<std::optional<RayHit>> hits) const {
  assert(rays.size() == hits.size());
  for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - begin);
    alignas(32) std::array<int, kPacket> valid{};
    RTCRayHit8 query{};
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[begin + i];
      valid[i] = -1;
      query.ray.org_x[i] = static_cast<float>(ray.origin_mm.x());
      query.ray.org_y[i] = static_cast<float>(ray.origin_mm.y());
      query.ray.org_z[i] = static_cast<float>(ray.origin_mm.z());
      query.ray.dir_x[i] = static_cast<float>(ray.direction.x());
      query.ray.dir_y[i] = static_cast<float>(ray.direction.y());
      query.ray.dir_z[i] = static_cast<float>(ray.direction.z());
      query.ray.tfar[i] = kFar;
      query.ray.mask[i] = ~0U;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    find_hits(valid.data(), embree_->scene.get(), query, RayOrder::kCoherent);
    for (std::size_t i = 0; i < count; ++i) {
      hits[begin + i].reset();
      if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
        hits[begin + i] =
            make_hit(embree_->mesh, query.hit.primID[i], query.hit.u[i], query.hit.v[i]);
    }
  }
}

void RayScene::first_hits(const Isometry& T_model_sensor, const Vec3& origin_mm,
                          RayPacket& packet) const {
  using Numbers = RayPacket::Numbers;
  static_assert(RayPacket::kSize == kPacket);
  const Eigen::Matrix3f R_model_sensor = T_model_sensor.linear().cast<float>();
  const Vec3f origin = (T_model_sensor * origin_mm).cast<float>();
  const RayPacket::Vectors directions = rotated(R_model_sensor, packet.directions);
  alignas(32) std::array<int, kPacket> valid{};
  valid.fill(-1);
  RTCRayHit8 query{};
  const auto numbers = [](float* values) { return Eigen::Map<Numbers>(values); };
  numbers(query.ray.org_x) = origin.x();
  numbers(query.ray.org_y) = origin.y();
  numbers(query.ray.org_z) = origin.z();
  numbers(query.ray.dir_x) = directions[0];
  numbers(query.ray.dir_y) = directions[1];
  numbers(query.ray.dir_z) = directions[2];
  numbers(query.ray.tfar) = kFar;
  std::fill_n(query.ray.mask, kPacket, ~0U);
  std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  find_hits(valid.data(), embree_->scene.get(), query, RayOrder::kAny);
  packet.distances_mm = numbers(query.ray.tfar);
  packet.normals =
      rotated(R_model_sensor.transpose(),
              {numbers(query.hit.Ng_x), numbers(query.hit.Ng_y), numbers(query.hit.Ng_z)});
  const Numbers length =
      (packet.normals[0].square() + packet.normals[1].square() + packet.normals[2].square())
          .sqrt()
          .max(std::numeric_limits<float>::min());
  for (Numbers& coordinate : packet.normals) coordinate /= length;
  std::copy_n(query.hit.primID, kPacket, packet.triangles.begin());
  packet.u = numbers(query.hit.u);
  packet.v = numbers(query.hit.v);
}

bool RayScene::blocked(const Vec3& point_mm, const Vec3& normal, const Vec3& to_mm) const {
  const double side = normal.dot(to_mm - point_mm) >= 0.0 ? 1.0 : -1.0;
  const Vec3 start = point_mm + side * embree_->lift_mm * normal;
  const Vec3f origin = start.cast<float>();
  const Vec3f direction = (to_mm - start).cast<float>();
  RTCRay query{
      origin.x(), origin.y(), origin.z(), 0.0F, direction.x(), direction.y(), direction.z(), 0.0F,
      1.0F,       ~0U,        0,          0};
  find_blocker(embree_->scene.get(), query);
  return query.tfar < 0.0F;
}

void RayScene::cast_shadows(std::span<Shadow> shadows, const Vec3& to_mm) const {
  for (std::size_t begin = 0; begin < shadows.size(); begin += kPacket) {
    const std::size_t count = std::min(kPacket, shadows.size() - begin);
    alignas(32) std::array<int, kPacket> valid{};
    RTCRay8 query{};
    for (std::size_t i = 0; i < count; ++i) {
      const Shadow& shadow = shadows[begin + i];
      const double side = shadow.normal.dot(to_mm - shadow.point_mm) >= 0.0 ? 1.0 : -1.0;
      const Vec3 start = shadow.point_mm + side * embree_->lift_mm * shadow.normal;
      const Vec3f direction = (to_mm - start).cast<float>();
      valid[i] = -1;
      query.org_x[i] = static_cast<float>(start.x());
      query.org_y[i] = static_cast<float>(start.y());
      query.org_z[i] = static_cast<float>(start.z());
      query.dir_x[i] = direction.x();
      query.dir_y[i] = direction.y();
      query.dir_z[i] = direction.z();
      query.tfar[i] = 1.0F;
      query.mask[i] = ~0U;
    }
    find_blockers(valid.data(), embree_->scene.get(), query, RayOrder::kCoherent);
    for (std::size_t i = 0; i < count; ++i) shadows[begin + i].blocked = query.tfar[i] < 0.0F;
  }
}

Vec3 color_at(const TriangleMesh& mesh, const RayHit& hit) {
  Vec3 color = Vec3::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    const Rgb& rgb = mesh.vertices[mesh.triangles[hit.triangle][corner]].color;
    color += hit.weights[corner] * Vec3(rgb[0], rgb[1], rgb[2]);
  }
  return color;
}

Vec3 smooth_normal_at(const TriangleMesh& mesh, const RayHit& hit) {
  Vec3 normal = Vec3::Zero();
  for (int corner = 0; corner < 3; ++corner)
    normal += hit.weights[corner] *
              mesh.vertices[mesh.triangles[hit.triangle][corner]].normal.cast<double>();
  const double length = normal.norm();
  return length > 1e-3 ? Vec3(normal / length) : hit.normal;
}

}  // namespace flytri::simulated
