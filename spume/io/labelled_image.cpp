#include "spume/io/labelled_image.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "spume/base/error.hpp"

namespace spume::io {

namespace {

/// Counts errors of VTK in place of printing them.
struct ErrorCounter {
  ErrorCounter() {
    command->SetClientData(&n_errors);
    command->SetCallback([](vtkObject*, unsigned long, void* n, void*) { ++*static_cast<int*>(n); });
  }
  int n_errors = 0;
  vtkNew<vtkCallbackCommand> command;
};

template <class Reader>
vtkSmartPointer<vtkImageData> read_with(const std::filesystem::path& path, ErrorCounter& errors) {
  vtkNew<Reader> reader;
  reader->AddObserver("ErrorEvent", errors.command);
  if constexpr (std::is_same_v<Reader, vtkXMLImageDataReader>) {
    reader->SetReaderErrorObserver(errors.command);
    reader->SetParserErrorObserver(errors.command);
  }
  if (reader->CanReadFile(path.c_str()) == 0)
    throw InputError(fmt::format("{}: damaged, or not what the ending of its name says", path.string()));
  reader->SetFileName(path.c_str());
  reader->Update();
  if (errors.n_errors > 0 || reader->GetErrorCode() != 0)
    throw InputError(fmt::format("{}: damaged", path.string()));
  return reader->GetOutput();
}

/// MetaImage files that were cut short are taken for whole by VTK, unless they are compressed.
void check_length(const std::filesystem::path& path, vtkImageData& data) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  bool compressed = false;
  std::string data_file;
  while (std::getline(stream, line)) {
    const bool is_true = line.find("True") != std::string::npos;
    if (line.rfind("CompressedData ", 0) == 0) compressed = is_true;
    if (line.rfind("ElementDataFile", 0) != 0) continue;
    const auto begin = line.find_first_not_of(" =", std::string("ElementDataFile").size());
    const auto end = line.find_last_not_of(" \r");
    if (begin <= end) data_file = line.substr(begin, end - begin + 1);
    break;  // the last line before the data
  }
  const bool in_one_file = data_file.find('%') == std::string::npos && data_file.rfind("LIST", 0) != 0;
  if (compressed || !in_one_file) return;
  const bool is_local = data_file == "LOCAL" || data_file == "Local" || data_file == "local";
  const std::filesystem::path held_in = is_local ? path : path.parent_path() / data_file;
  const std::int64_t header = is_local ? static_cast<std::int64_t>(stream.tellg()) : 0;
  std::error_code unknown;
  const auto held = static_cast<std::int64_t>(std::filesystem::file_size(held_in, unknown)) - header;
  if (unknown) return;
  if (held < data.GetNumberOfPoints() * data.GetScalarSize())
    throw InputError(fmt::format("{}: damaged: {} is cut short", path.string(), held_in.string()));
}

vtkSmartPointer<vtkImageData> read_by_ending(const std::filesystem::path& path, ErrorCounter& errors) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file", path.string()));
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return tolower(c); });
  if (ending == ".vti") return read_with<vtkXMLImageDataReader>(path, errors);
  if (ending == ".mha" || ending == ".mhd") {
    const auto data = read_with<vtkMetaImageReader>(path, errors);
    check_length(path, *data);
    return data;
  }
  if (ending == ".nrrd" || ending == ".nhdr") return read_with<vtkNrrdReader>(path, errors);
  throw InputError(
      fmt::format("{}: not a labelled image: the ending must be vti, mha, mhd, nrrd or nhdr", path.string()));
}

/// The array with the labels: of points, or else of cells.
vtkDataArray& labels_of(vtkImageData& data, const std::filesystem::path& path, bool& of_cells) {
  const auto first_of = [](vtkDataSetAttributes* fields) {
    vtkDataArray* active = fields->GetScalars();
    return active != nullptr || fields->GetNumberOfArrays() == 0 ? active : fields->GetArray(0);
  };
  vtkDataArray* array = first_of(data.GetPointData());
  of_cells = array == nullptr;
  if (of_cells) array = first_of(data.GetCellData());
  if (array == nullptr) throw InputError(fmt::format("{}: holds no image", path.string()));
  if (array->GetNumberOfComponents() != 1)
    throw InputError(fmt::format("{}: has {} numbers a voxel; a labelled image has one", path.string(),
                                 array->GetNumberOfComponents()));
  if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
    throw InputError(fmt::format("{}: its voxels are {} numbers; labels are whole numbers", path.string(),
                                 array->GetDataTypeAsString()));
  return *array;
}

/// Gives bubbles their numbers in order of the labels.
void number_bubbles(const std::vector<std::int64_t>& voxel_label, LabelledImage& image) {
  for (std::size_t n = 0; n < voxel_label.size(); ++n)
    if (voxel_label[n] != 0 && (n == 0 || voxel_label[n] != voxel_label[n - 1]))
      image.label.push_back(voxel_label[n]);
  std::sort(image.label.begin(), image.label.end());
  image.label.erase(std::unique(image.label.begin(), image.label.end()), image.label.end());
  image.phase.resize(voxel_label.size());
  for (std::size_t n = 0; n < voxel_label.size(); ++n) {
    const auto place = std::lower_bound(image.label.begin(), image.label.end(), voxel_label[n]);
    image.phase[n] = voxel_label[n] == 0 ? 0 : static_cast<int>(place - image.label.begin()) + 1;
  }
}

}  // namespace

LabelledImage read_labelled_image(const std::filesystem::path& path) {
  ErrorCounter errors;
  const vtkSmartPointer<vtkImageData> data = read_by_ending(path, errors);
  bool of_cells = false;
  vtkDataArray& labels = labels_of(*data, path, of_cells);

  LabelledImage image;
  const std::array<double, 6> bounds = [&] {
    std::array<double, 6> b;
    data->GetBounds(b.data());
    return b;
  }();
  for (int d = 0; d < 3; ++d) {
    image.voxels[d] = data->GetDimensions()[d] - (of_cells ? 1 : 0);
    image.spacing[d] = data->GetSpacing()[d];
    image.lower[d] = bounds[2 * d] - (of_cells ? 0 : 0.5 * image.spacing[d]);
    if (image.voxels[d] < 2)
      throw InputError(
          fmt::format("{}: is flat; a labelled image has voxels along x, y and z", path.string()));
  }
  const auto n_voxels = static_cast<vtkIdType>(image.voxels.i) * image.voxels.j * image.voxels.k;
  if (labels.GetNumberOfTuples() != n_voxels) throw InputError(fmt::format("{}: damaged", path.string()));
  std::vector<std::int64_t> voxel_label(n_voxels);
  for (vtkIdType n = 0; n < n_voxels; ++n) {
    voxel_label[n] = static_cast<std::int64_t>(labels.GetTuple1(n));
    if (voxel_label[n] < 0)
      throw InputError(fmt::format("{}: has the label {}; labels are ≥ 0", path.string(), voxel_label[n]));
  }
  number_bubbles(voxel_label, image);
  if (image.label.empty())
    throw InputError(fmt::format("{}: holds no bubble: every voxel has the label 0", path.string()));
  return image;
}

}  // namespace spume::io
