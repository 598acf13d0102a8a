#!/usr/bin/env bash
# Installs the Debian packages that building, testing and running spume needs and that are missing. Needs root or sudo
# without a password; otherwise prints the one command to run, and fails.
set -euo pipefail

packages=(
  g++ cmake ninja-build make ccache pkg-config git ca-certificates
  libopenmpi-dev openmpi-bin petsc-dev
  libfftw3-dev libfftw3-mpi-dev libeigen3-dev libsuitesparse-dev
  libopenblas0-serial # the BLAS of UMFPACK and PETSc; the reference BLAS is much slower
  libvtk9-dev libhdf5-openmpi-dev
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev
  libembree-dev libpng-dev
  libgtest-dev libgmock-dev
)

if ! command -v dpkg-query >/dev/null; then
  echo "This is no Debian system; spume needs what these Debian 12 packages hold: ${packages[*]}" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

install=(apt-get install --yes --no-install-recommends "${missing[@]}")
if [ "$(id -u)" -eq 0 ]; then
  as_root=(env)
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n env)
else
  echo "Packages are missing. Run this once, then make again:" >&2
  echo "  sudo sh -c 'apt-get update && ${install[*]}'" >&2
  exit 1
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
"${as_root[@]}" apt-get update --quiet
"${as_root[@]}" DEBIAN_FRONTEND=noninteractive "${install[@]}"
