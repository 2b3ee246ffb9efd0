// Arrays and attributes of an Hdf5File.
#include <algorithm>
#include <stdexcept>

#include "hdf5_handle.h"

namespace suffuse {

namespace {

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}

std::vector<hsize_t> sizes(const std::vector<std::size_t>& values) {
  return {values.begin(), values.end()};
}

hid_t space_for(const std::vector<std::size_t>& extents) {
  const std::vector<hsize_t> dims = sizes(extents);
  return H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
}

/// Selects a rank's part in the file's array; an empty part takes part with nothing.
void select(hid_t space, const ArrayPart& part) {
  if (std::find(part.count.begin(), part.count.end(), std::size_t{0}) != part.count.end()) {
    ensure(H5Sselect_none(space), "select nothing");
    return;
  }
  const std::vector<hsize_t> offset = sizes(part.offset), count = sizes(part.count);
  ensure(H5Sselect_hyperslab(space, H5S_SELECT_SET, offset.data(), nullptr, count.data(), nullptr),
         "select a part");
}

/// An array without values: there is nothing to write or read.
bool nothing_in(const ArrayPart& part) {
  return std::find(part.whole.begin(), part.whole.end(), std::size_t{0}) != part.whole.end();
}

std::size_t volume(const ArrayPart& part) {
  std::size_t product = 1;
  for (const std::size_t n : part.count) product *= n;
  return product;
}

template <class T>
void set_scalar(hid_t file, const std::string& object, const std::string& name, T value) {
  if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
    ensure(H5Adelete_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT), "replace attribute " + name);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar");
  const Id attribute(H5Acreate_by_name(file, object.c_str(), name.c_str(), type_of<T>(), space, H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  ensure(H5Awrite(attribute, type_of<T>(), &value), "write attribute " + name);
}

template <class T>
T get_scalar(hid_t file, const std::string& object, const std::string& name) {
  const Id attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                     "find attribute " + name + " of " + object);
  T value{};
  ensure(H5Aread(attribute, type_of<T>(), &value), "read attribute " + name);
  return value;
}

}  // namespace

template <class T>
void Hdf5File::create_array(const std::string& dataset, const std::vector<std::size_t>& extents) {
  together([&] {
    const Id space(space_for(extents), H5Sclose, "shape " + dataset);
    const Id id(
        H5Dcreate(handle_->file, dataset.c_str(), type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose, "create " + dataset + " in " + path_);
    if (handle_->growth != nullptr) add_bytes_of(id, handle_->new_arrays);
  });
}

namespace {

/// This rank's part of a dataset, the values for it in memory, and that all ranks transfer theirs together.
struct Transfer {
  Transfer(const Id& dataset, const std::string& name, const ArrayPart& part)
      : file(H5Dget_space(dataset), H5Sclose, "shape " + name) {
    select(file, part);
    ensure(H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE), "transfer " + name + " together");
    const hsize_t length = volume(part);
    ensure(H5Sset_extent_simple(memory, 1, &length, nullptr), "shape memory");
  }
  Id file;
  Id memory{H5Screate(H5S_SIMPLE), H5Sclose, "shape memory"};
  Id together{H5Pcreate(H5P_DATASET_XFER), H5Pclose, "set up a transfer"};
};

}  // namespace

template <class T>
void Hdf5File::write(const std::string& dataset, const ArrayPart& part, const std::vector<T>& values) {
  if (values.size() != volume(part))
    throw std::logic_error("Hdf5File::write: " + dataset + " has another size");
  if (nothing_in(part)) return;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose, "open " + dataset);
    const Transfer parts(id, dataset, part);
    ensure(H5Dwrite(id, type_of<T>(), parts.memory, parts.file, parts.together, values.data()),
           "write " + dataset + " to " + path_);
  });
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& dataset, const ArrayPart& part) const {
  std::vector<T> values;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose,
                "find " + dataset + " in " + path_);
    const Transfer parts(id, dataset, part);
    values.resize(volume(part));
    ensure(H5Dread(id, type_of<T>(), parts.memory, parts.file, parts.together, values.data()),
           "read " + dataset + " of " + path_);
  });
  return values;
}

std::vector<std::size_t> Hdf5File::extents(const std::string& dataset) const {
  std::vector<std::size_t> extents;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose,
                "find " + dataset + " in " + path_);
    const Id space(H5Dget_space(id), H5Sclose, "shape " + dataset);
    std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    extents.assign(dims.begin(), dims.end());
  });
  return extents;
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  together([&] { set_scalar(handle_->file, object, name, value); });
}
void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  together([&] { set_scalar(handle_->file, object, name, value); });
}
void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& value) {
  together([&] {
    if (H5Aexists_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
      ensure(H5Adelete_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT),
             "replace attribute " + name);
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
    ensure(H5Tset_size(type, value.size() + 1), "size a text");
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar");
    const Id attribute(H5Acreate_by_name(handle_->file, object.c_str(), name.c_str(), type, space,
                                         H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "create attribute " + name);
    ensure(H5Awrite(attribute, type, value.c_str()), "write attribute " + name);
  });
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  double value{};
  together([&] { value = get_scalar<double>(handle_->file, object, name); });
  return value;
}
std::int64_t Hdf5File::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value{};
  together([&] { value = get_scalar<std::int64_t>(handle_->file, object, name); });
  return value;
}
std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  std::string value;
  together([&] {
    const Id attribute(H5Aopen_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "find attribute " + name + " of " + object);
    const Id type(H5Aget_type(attribute), H5Tclose, "type attribute " + name);
    value.assign(H5Tget_size(type), '\0');
    ensure(H5Aread(attribute, type, value.data()), "read attribute " + name);
  });
  return value.substr(0, value.find('\0'));
}

#define SUFFUSE_INSTANTIATE(T)                                                                   \
  template void Hdf5File::create_array<T>(const std::string&, const std::vector<std::size_t>&);  \
  template void Hdf5File::write<T>(const std::string&, const ArrayPart&, const std::vector<T>&); \
  template std::vector<T> Hdf5File::read<T>(const std::string&, const ArrayPart&) const;
SUFFUSE_INSTANTIATE(double)
SUFFUSE_INSTANTIATE(float)
SUFFUSE_INSTANTIATE(std::uint8_t)
SUFFUSE_INSTANTIATE(std::int64_t)
#undef SUFFUSE_INSTANTIATE

}  // namespace suffuse
