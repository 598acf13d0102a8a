#include "spume/simulation/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace spume::simulation {

namespace {

constexpr double shortest_interval = 0.2;  // wall seconds between two live lines

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A duration as people say it: "42 s", "3 min 20 s", "2 h 05 min".
std::string spoken(double seconds) {
  const long s = static_cast<long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

/// Characters that fit on a line of the terminal; a longer live line would wrap and could not be rewritten.
std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 160u;
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressLine::ProgressLine(bool enabled) : enabled_(enabled), started_(wall_seconds()) {}

ProgressLine::~ProgressLine() {
  if (enabled_ && width_ > 0) print("\n");
}

void ProgressLine::show(const ProgressState& state) {
  if (!enabled_) return;
  const double now = wall_seconds() - started_;
  if (last_shown_ >= 0 && now - last_shown_ < shortest_interval) return;
  last_shown_ = now;
  std::string line = fmt::format("{:<11} t = {:<9.4g} s  dt = {:.2e} s", state.stage, state.time, state.dt);
  if (!state.limited_by.empty()) line += fmt::format(" ({})", state.limited_by);
  line += fmt::format("  bubbles {}  ruptures {}  {}", state.bubbles, state.ruptures, spoken(now));
  // The first instants of a run say nothing of the rest.
  if (state.fraction > 0.001 && state.fraction <= 1 && now > 2)
    line += fmt::format(", about {} left", spoken(now * (1 - state.fraction) / state.fraction));
  line.resize(std::min(line.size(), terminal_width()));
  const std::size_t width = line.size();
  if (width < width_) line.append(width_ - width, ' ');
  width_ = width;
  print("\r" + line);
}

void ProgressLine::announce(const std::string& text) {
  if (!enabled_) return;
  // Blanks over what a longer live line would leave behind the text.
  const std::size_t blanks = text.size() < width_ ? width_ - text.size() : 0;
  print("\r" + text + std::string(blanks, ' ') + "\n");
  width_ = 0;
  last_shown_ = -1;
}

}  // namespace spume::simulation
