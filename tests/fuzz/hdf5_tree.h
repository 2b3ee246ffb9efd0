#pragma once

// HDF5 files as another program, or a broken one, might have written them: shapes, types and numbers that our
// readers do not expect, taken from the bytes of an input. Broken bytes of HDF5 itself are HDF5's affair.

#include <hdf5.h>

#include <string>
#include <vector>

#include "fuzz_input.h"

namespace suffuse::fuzz {

class Hdf5Tree {
 public:
  explicit Hdf5Tree(const std::string& path)
      : id_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {
    H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Tree() { H5Fclose(id_); }
  Hdf5Tree(const Hdf5Tree&) = delete;
  Hdf5Tree& operator=(const Hdf5Tree&) = delete;

  void group(const std::string& name) {
    const hid_t group = H5Gcreate(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (group >= 0) H5Gclose(group);
  }

  /// An array of the shape wanted, most often; of another shape or type, or none, otherwise. Numbers of
  /// `values`, with one now and then from the bytes.
  void array(const std::string& name, std::vector<hsize_t> shape, const std::vector<double>& values,
             Bytes& bytes) {
    const int fault = bytes.below(12);
    if (fault == 1) return;
    if (fault == 2 && !shape.empty()) shape.back() = static_cast<hsize_t>(bytes.below(6));
    if (fault == 3 && !shape.empty()) shape.front() = static_cast<hsize_t>(bytes.below(6));
    if (fault == 4) shape.push_back(static_cast<hsize_t>(bytes.below(3)));
    if (fault == 5 && !shape.empty()) shape.pop_back();
    if (fault == 6) {
      group(name);
      return;
    }
    hsize_t count = 1;
    for (const hsize_t n : shape) count *= n;
    std::vector<double> numbers(count);
    for (std::size_t k = 0; k < count; ++k) numbers[k] = values.empty() ? 0 : values[k % values.size()];
    if (fault >= 9)
      for (int changes = 1 + bytes.below(3); count > 0 && changes > 0; --changes)
        numbers[static_cast<std::size_t>(bytes.next()) % count] = bytes.number();
    const hid_t type = fault == 7   ? text_type()
                       : fault == 8 ? H5Tcopy(H5T_STD_I16LE)
                                    : H5Tcopy(H5T_IEEE_F64LE);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t data = H5Dcreate(id_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (data >= 0) {
      if (fault != 7 && count > 0)
        H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
      H5Dclose(data);
    }
    H5Sclose(space);
    H5Tclose(type);
  }

  void attribute(const std::string& object, const std::string& name, double value, Bytes& bytes) {
    const int fault = bytes.below(6);
    if (fault == 1) return;
    if (fault == 2) value = bytes.number();
    if (fault == 3) {
      attribute(object, name, std::string("soon"));
      return;
    }
    write(object, name, H5T_NATIVE_DOUBLE, &value);
  }
  void attribute(const std::string& object, const std::string& name, const std::string& value) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, value.size() + 1);
    write(object, name, type, value.c_str());
    H5Tclose(type);
  }

 private:
  static hid_t text_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 8);
    return type;
  }
  void write(const std::string& object, const std::string& name, hid_t type, const void* value) {
    const hid_t at = H5Oopen(id_, object.c_str(), H5P_DEFAULT);
    if (at < 0) return;
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute >= 0) {
      H5Awrite(attribute, type, value);
      H5Aclose(attribute);
    }
    H5Sclose(space);
    H5Oclose(at);
  }

  hid_t id_;
};

}  // namespace suffuse::fuzz
