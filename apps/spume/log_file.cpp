#include "apps/spume/log_file.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <mutex>

#include "apps/spume/output_folder.hpp"

namespace spume::app {

namespace {

/// Writes lines to log.txt from the moment on when the folder holds a run.
class LateFile : public spdlog::sinks::base_sink<std::mutex> {
 public:
  LateFile(std::filesystem::path folder, std::ios::openmode mode) : folder_(std::move(folder)), mode_(mode) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    waiting_.append(line.data(), line.size());
  }

  void flush_() override {
    if (!file_.is_open() && holds_run(folder_)) file_.open(folder_ / "log.txt", mode_);
    if (!file_.is_open()) return;
    file_ << waiting_ << std::flush;
    waiting_.clear();
  }

  std::filesystem::path folder_;
  std::ios::openmode mode_;
  std::ofstream file_;
  std::string waiting_;
};

}  // namespace

LogFile::LogFile(const parallel::Communicator& communicator, const std::filesystem::path& folder, Mode mode) {
  spdlog::sink_ptr sink;
  if (communicator.is_root())
    sink = std::make_shared<LateFile>(folder, mode == Mode::New ? std::ios::trunc : std::ios::app);
  else
    sink = std::make_shared<spdlog::sinks::null_sink_mt>();
  const auto logger = std::make_shared<spdlog::logger>("spume", sink);
  logger->set_pattern("%Y-%m-%d %H:%M:%S  %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

LogFile::~LogFile() {
  spdlog::default_logger()->flush();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::null_sink_mt>()));
}

}  // namespace spume::app
