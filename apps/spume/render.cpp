#include "spume/optics/render.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/spume/commands.hpp"
#include "spume/base/error.hpp"
#include "spume/io/pvd_series.hpp"
#include "spume/io/vtk_films.hpp"

namespace spume::app {

namespace {

namespace fs = std::filesystem;

struct Request {
  std::string source, style = "bubbles", frame = "last", size = "1000x800", output;
};

/// A picture to make: the films of `file` into `picture`.
struct Job {
  fs::path file, picture;
};

/// The whole of `text` as a number that is not negative; −1 when it is none.
int whole_number(std::string_view text) {
  int value = -1;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size() ? value : -1;
}

void read_size(const std::string& size, optics::RenderOptions& options) {
  const auto cross = size.find('x');
  options.width = whole_number(std::string_view(size).substr(0, cross));
  options.height = cross == std::string::npos ? -1 : whole_number(std::string_view(size).substr(cross + 1));
  constexpr int largest = 16384;
  if (options.width < 16 || options.height < 16 || options.width > largest || options.height > largest)
    throw InputError(fmt::format("--size {}: must be WIDTHxHEIGHT in pixels, from 16 to {}, as in 1000x800",
                                 size, largest));
}

optics::Style style_of(const std::string& name) {
  if (name == "bubbles") return optics::Style::Bubbles;
  if (name == "thickness") return optics::Style::Thickness;
  if (name == "interference")
    throw InputError("--style interference: is not available in this version; use bubbles or thickness");
  throw InputError("--style " + name + ": must be bubbles or thickness");
}

/// Name of the picture of one frame of many: films_000012.vtp gives bubbles_000012.png.
std::string picture_name(const Request& request, std::size_t frame) {
  const std::string stem = request.output.empty() ? request.style : fs::path(request.output).stem().string();
  return fmt::format("{}_{:06}.png", stem, frame);
}

std::vector<Job> jobs_of_series(const Request& request, const fs::path& folder) {
  if (!fs::exists(folder / "films.pvd")) throw InputError(folder.string() + ": holds no films.pvd of a run");
  const auto frames = io::read_pvd(folder / "films.pvd");
  if (frames.empty()) throw InputError(folder.string() + ": has no frames yet");
  const auto file = [&](std::size_t frame) { return folder / frames[frame].file; };
  if (request.frame == "all") {
    const fs::path beside =
        request.output.empty() ? folder / "pictures" : fs::path(request.output).parent_path();
    std::vector<Job> jobs;
    for (std::size_t frame = 0; frame < frames.size(); ++frame)
      jobs.push_back({file(frame), beside / picture_name(request, frame)});
    return jobs;
  }
  const int last = static_cast<int>(frames.size()) - 1;
  const int frame = request.frame == "last" ? last : whole_number(request.frame);
  if (frame < 0 || frame > last)
    throw InputError(
        fmt::format("--frame {}: must be last, all, or a number from 0 to {}", request.frame, last));
  return {{file(frame),
           request.output.empty() ? folder / picture_name(request, frame) : fs::path(request.output)}};
}

std::vector<Job> jobs_of(const Request& request) {
  const fs::path source = request.source;
  if (fs::is_directory(source)) return jobs_of_series(request, source);
  if (request.frame != "last")
    throw InputError("--frame goes with the folder of a run, not with a single file");
  return {{source,
           request.output.empty() ? fs::path(source).replace_extension(".png") : fs::path(request.output)}};
}

/// One camera and one scale of colours for all pictures of a series.
void fix_view(const std::vector<Job>& jobs, optics::RenderOptions& options) {
  for (const Job& job : jobs) {
    const auto frame = io::read_films(job.file);
    if (frame.triangle.empty()) continue;
    const auto [lower, upper] = optics::bounds(frame);
    const auto range = optics::thickness_range(frame);
    if (!options.view_box) options.view_box = {lower, upper}, options.range = range;
    for (int axis = 0; axis < 3; ++axis) {
      auto& box = *options.view_box;
      box[0][axis] = std::min(box[0][axis], lower[axis]);
      box[1][axis] = std::max(box[1][axis], upper[axis]);
    }
    options.range->smallest = std::min(options.range->smallest, range.smallest);
    options.range->largest = std::max(options.range->largest, range.largest);
  }
}

void render(const Request& request) {
  optics::RenderOptions options;
  options.style = style_of(request.style);
  read_size(request.size, options);
  const std::vector<Job> jobs = jobs_of(request);
  if (jobs.size() > 1) fix_view(jobs, options);
  for (const Job& job : jobs) {
    const auto frame = io::read_films(job.file);
    const fs::path folder = fs::absolute(job.picture).parent_path();
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder, error) || ::access(folder.c_str(), W_OK | X_OK) != 0)
      throw InputError(job.picture.string() + ": cannot be written");
    optics::render(frame, options, job.picture);
    std::printf("%s  t = %g s\n", job.picture.c_str(), frame.time);
  }
}

}  // namespace

void add_render(CLI::App& program, const parallel::Communicator& communicator) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = program.add_subcommand("render", "pictures of the films of a run");
  command->add_option("DIR|FILE.vtp", request->source, "output folder of a run, or one file of films")
      ->required();
  command->add_option("--style", request->style, "bubbles, or thickness of the films in colours")
      ->capture_default_str();
  command->add_option("--frame", request->frame, "number of a frame, last or all")->capture_default_str();
  command->add_option("--size", request->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  command->add_option(
      "-o,--output", request->output,
      "the picture; with --frame all the beginning of their names; by default into the folder");
  command->callback([request, communicator] { communicator.on_root([&] { render(*request); }); });
}

}  // namespace spume::app
