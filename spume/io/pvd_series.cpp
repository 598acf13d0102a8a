#include "spume/io/pvd_series.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <string_view>

#include "spume/base/error.hpp"
#include "spume/io/durable.hpp"

namespace spume::io {

namespace {

/// What stands in `line` between the quotes after `key="`; empty when the key is not there.
std::string_view attribute(std::string_view line, std::string_view key) {
  const std::string start = fmt::format("{}=\"", key);
  const auto first = line.find(start);
  if (first == std::string_view::npos) return {};
  line.remove_prefix(first + start.size());
  return line.substr(0, line.find('"'));
}

}  // namespace

PvdSeries::PvdSeries(std::filesystem::path path) : path_(std::move(path)) {
  write();
}

PvdSeries::PvdSeries(std::filesystem::path path, int n_frames)
    : path_(std::move(path)), frames_(read_pvd(path_)) {
  if (static_cast<int>(frames_.size()) < n_frames)
    throw InputError(fmt::format("{}: has {} frames, but the checkpoint refers to {}", path_.string(),
                                 frames_.size(), n_frames));
  frames_.resize(n_frames);
  write();
}

void PvdSeries::append(double time, const std::string& file) {
  frames_.push_back({time, file});
  write();
}

void PvdSeries::write() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const Frame& frame : frames_)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, frame.file);
  write_text_durably(path_, text + "  </Collection>\n</VTKFile>\n");
}

std::vector<PvdSeries::Frame> read_pvd(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be read", path.string()));
  std::vector<PvdSeries::Frame> frames;
  for (std::string line; std::getline(file, line);) {
    if (line.find("<DataSet ") == std::string::npos) continue;
    const std::string_view time = attribute(line, "timestep"), name = attribute(line, "file");
    PvdSeries::Frame frame{0, std::string(name)};
    const auto parsed = std::from_chars(time.data(), time.data() + time.size(), frame.time);
    if (name.empty() || parsed.ec != std::errc{})
      throw InputError(fmt::format("{}: not a series of frames: '{}'", path.string(), line));
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace spume::io
