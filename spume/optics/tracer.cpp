#include "spume/optics/tracer.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "spume/base/contract.hpp"

namespace spume::optics {

namespace {

constexpr unsigned film_id = 0, border_id = 1;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Films met so far by one ray, in no order; only the nearest are kept. Starts with what Embree hands to
/// filters.
struct Collector {
  RTCIntersectContext context;
  std::span<Hit> hits;
  int n = 0;

  void add(const Hit& hit) {
    // A ray through an edge or a vertex may meet the triangles on both sides: one film is one hit.
    for (int h = 0; h < n; ++h)
      if (std::abs(hits[h].distance - hit.distance) < 1e-6 * hit.distance) return;
    if (n < static_cast<int>(hits.size())) {
      hits[n++] = hit;
      return;
    }
    const auto farthest = std::max_element(hits.begin(), hits.end(), nearer);
    if (nearer(hit, *farthest)) *farthest = hit;
  }
  static bool nearer(const Hit& a, const Hit& b) { return a.distance < b.distance; }
};

/// Called by Embree for each surface on the ray: films are noted and passed, borders stop the ray.
void note_films(const RTCFilterFunctionNArguments* arguments) {
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] != -1 || hit.geomID != film_id) return;
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  auto& collector = *reinterpret_cast<Collector*>(arguments->context);
  collector.add({ray.tfar, static_cast<int>(hit.primID), {1.0 - hit.u - hit.v, hit.u, hit.v}, {}});
  arguments->valid[0] = 0;
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree failed with error {}", static_cast<int>(error)));
}

}  // namespace

struct Tracer::Implementation {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  Vec3 centre;
  double scale = 1;  ///< unit of the points / unit of Embree's

  ~Implementation() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  void put(float* place, const Vec3& x) const {
    for (int axis = 0; axis < 3; ++axis) place[axis] = static_cast<float>((x[axis] - centre[axis]) / scale);
  }
  void fit(const state::FilmFrame& frame);
  void add_films(const state::FilmFrame& frame);
  void add_borders(const state::FilmFrame& frame, std::span<const double> radius);
};

void Tracer::Implementation::fit(const state::FilmFrame& frame) {
  if (frame.film_point.empty()) return;
  Vec3 lowest = frame.film_point[0], highest = lowest;
  for (const Vec3& x : frame.film_point)
    for (int axis = 0; axis < 3; ++axis) {
      lowest[axis] = std::min(lowest[axis], x[axis]);
      highest[axis] = std::max(highest[axis], x[axis]);
    }
  centre = 0.5 * (lowest + highest);
  if (norm(highest - lowest) > 0) scale = norm(highest - lowest);
}

void Tracer::Implementation::add_films(const state::FilmFrame& frame) {
  if (frame.triangle.empty()) return;
  RTCGeometry films = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      films, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), frame.film_point.size()));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      films, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), frame.triangle.size()));
  check(device);
  for (const Vec3& x : frame.film_point) {
    put(vertex, x);
    vertex += 3;
  }
  for (const auto& triangle : frame.triangle)
    for (int p : triangle.point) *index++ = static_cast<unsigned>(p);
  rtcCommitGeometry(films);
  rtcAttachGeometryByID(scene, films, film_id);
  rtcReleaseGeometry(films);
}

void Tracer::Implementation::add_borders(const state::FilmFrame& frame, std::span<const double> radius) {
  expects(radius.size() == frame.border_point.size(), "one radius for each border point");
  std::size_t n_segments = 0;
  for (const auto& line : frame.border_line) n_segments += std::max<std::size_t>(line.size(), 1) - 1;
  if (n_segments == 0) return;
  RTCGeometry borders = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      borders, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * n_segments));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      borders, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), n_segments));
  check(device);
  unsigned first = 0;
  for (const auto& line : frame.border_line)
    for (std::size_t s = 0; s + 1 < line.size(); ++s, first += 2) {
      for (int p : {line[s], line[s + 1]}) {
        put(vertex, frame.border_point[p]);
        vertex[3] = static_cast<float>(radius[p] / scale);
        vertex += 4;
      }
      *index++ = first;
    }
  rtcCommitGeometry(borders);
  rtcAttachGeometryByID(scene, borders, border_id);
  rtcReleaseGeometry(borders);
}

Tracer::Tracer(const state::FilmFrame& frame, std::span<const double> border_radius)
    : implementation_(std::make_unique<Implementation>()) {
  auto& self = *implementation_;
  check(self.device);
  self.fit(frame);
  rtcSetSceneFlags(
      self.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  self.add_films(frame);
  self.add_borders(frame, border_radius);
  rtcCommitScene(self.scene);
  check(self.device);
}

Tracer::~Tracer() = default;

int Tracer::trace(const Vec3& origin, const Vec3& direction, std::span<Hit> hits) const {
  const auto& self = *implementation_;
  Collector collector{{}, hits};
  rtcInitIntersectContext(&collector.context);
  collector.context.filter = note_films;
  RTCRayHit ray{};
  self.put(&ray.ray.org_x, origin);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tfar = infinity;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(self.scene, &collector.context, &ray);

  if (ray.hit.geomID == border_id) {
    // Films behind the border may have been noted before it was met.
    const auto behind = std::remove_if(hits.begin(), hits.begin() + collector.n,
                                       [&](const Hit& hit) { return hit.distance > ray.ray.tfar; });
    collector.n = static_cast<int>(behind - hits.begin());
    collector.add({ray.ray.tfar, -1, {}, normalized({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z})});
  }
  const auto met = hits.first(static_cast<std::size_t>(collector.n));
  std::sort(met.begin(), met.end(), Collector::nearer);
  for (Hit& hit : met) hit.distance *= self.scale;
  return collector.n;
}

}  // namespace spume::optics
