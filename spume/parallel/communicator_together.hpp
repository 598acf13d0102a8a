#pragma once

#include <exception>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::parallel {

template <class Work>
void Communicator::together(Work&& work) const {
  Failure failure = Failure::None;
  std::string message;
  try {
    std::forward<Work>(work)();
  } catch (const InputError& error) {
    failure = Failure::Input;
    message = error.what();
  } catch (const NumericalError& error) {
    failure = Failure::Numerical;
    message = error.what();
  } catch (const Interrupted& error) {
    failure = Failure::Interruption;
    message = error.what();
  } catch (const std::exception& error) {
    failure = Failure::Other;
    message = error.what();
  } catch (...) {
    failure = Failure::Other;
    message = "unknown exception";
  }
  rethrow_together(failure, std::move(message));
}

template <class Work>
void Communicator::on_root(Work&& work) const {
  together([&] {
    if (is_root()) std::forward<Work>(work)();
  });
}

}  // namespace spume::parallel
