#pragma once

#include <memory>
#include <vector>

#include "face_patches.h"
#include "halo_exchange.h"
#include "kernel_choice.h"
#include "partial_solid_store.h"
#include "populations.h"
#include "solid_links.h"
#include "suffuse/lbm/fluid.h"
#include "wall_links.h"

namespace suffuse::lbm {

/// What Fluid hides: the same for both storage types. Cells here are local: 0 <= x < extent of the sub-box.
class FluidCoreBase {
 public:
  FluidCoreBase(const FluidSettings& settings, const Decomposition& decomposition);
  virtual ~FluidCoreBase() = default;

  virtual void step(RowVisitor* visitor) = 0;
  virtual int rows_per_block() const = 0;
  virtual double population(int direction, int x, int y, int z) const = 0;
  virtual void set_population(int direction, int x, int y, int z, double value) = 0;
  virtual void set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of) = 0;
  virtual void set_walls(const Walls& walls) = 0;
  virtual PartialSolidArrays use_partial_solids(const PartialSolidSettings& settings) = 0;
  /// Sums over the solids of a cell; zero without partly covered cells.
  virtual PartialSolidCell partial_solid(int x, int y, int z) const = 0;
  virtual std::uint8_t solid_label(int x, int y, int z) const = 0;
  /// Behind walls there is no water.
  bool is_closed(int x, int y, int z) const {
    if (closed_.empty()) return false;
    const CellBox& box = decomposition.local_box();
    return closed_[static_cast<std::size_t>(x + box.extent(0) * (y + std::ptrdiff_t{box.extent(1)} * z))] !=
           0;
  }
  bool has_closed() const { return !closed_.empty(); }
  /// No fluid, but for what a partly covered cell leaves open.
  bool is_solid(int x, int y, int z) const { return solid_label(x, y, z) != 0 || is_closed(x, y, z); }
  virtual Vec3 local_solid_force(std::uint8_t label) const = 0;
  virtual std::size_t bytes() const = 0;
  virtual void bare_update() = 0;

  FluidPoint at(int x, int y, int z) const;

  /// Deviation from density one and momentum of the populations of each cell of a row, half of the force
  /// included; solids are not looked at.
  struct RowMoments {
    std::vector<double> deviation, momentum[3];
    void resize(std::size_t cells) {
      deviation.resize(cells);
      for (auto& component : momentum) component.resize(cells);
    }
  };
  virtual void moments_of_row(int y, int z, RowMoments& moments) const = 0;
  /// What `at` is in a cell that is no solid, from its moments and what covers it in part.
  FluidPoint point_of(double deviation, const Vec3& momentum, const PartialSolidCell& solids) const;

  FluidSettings settings;
  Decomposition decomposition;
  InstructionSet instruction_set;
  Vec3 force = Vec3::Zero();
  long steps = 0;
  std::optional<PartialSolidSettings> partial_solids;
  bool odd = false;  ///< the next step is an odd one of the AA pattern

 protected:
  std::vector<std::uint8_t> closed_;  ///< Walls::closed
};

/// The populations of one rank and the four parts of a step: kernel, halo exchange, faces, solids.
template <class T>
class FluidCore final : public FluidCoreBase {
 public:
  FluidCore(const FluidSettings& settings, const Decomposition& decomposition);

  void step(RowVisitor* visitor) override;
  int rows_per_block() const override;
  void bare_update() override;
  double population(int direction, int x, int y, int z) const override;
  void moments_of_row(int y, int z, RowMoments& moments) const override;
  void set_population(int direction, int x, int y, int z, double value) override;
  void set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of) override;
  void set_walls(const Walls& walls) override;
  PartialSolidArrays use_partial_solids(const PartialSolidSettings& settings) override;
  PartialSolidCell partial_solid(int x, int y, int z) const override {
    return store_ ? store_->cell(populations_.index(x, y, z)) : PartialSolidCell{};
  }
  std::uint8_t solid_label(int x, int y, int z) const override {
    return labels_ ? labels_->at(x, y, z) : std::uint8_t{0};
  }
  Vec3 local_solid_force(std::uint8_t label) const override {
    return links_ ? links_->force(label) : Vec3::Zero();
  }
  std::size_t bytes() const override {
    return populations_.bytes() + (labels_ ? labels_->bytes() : 0) + (store_ ? store_->bytes() : 0) +
           (walls_ ? walls_->bytes() : 0) + closed_.size();
  }

 private:
  KernelCall<T> kernel_call();
  SolidKind solid_kind() const;
  void sweep(Kernel<T> kernel, RowVisitor* visitor);
  void sweep_planes(Kernel<T> kernel, RowVisitor* visitor, int begin_z, int end_z);
  void sweep_rows(KernelCall<T>& call, Kernel<T> kernel, RowVisitor* visitor);
  void clear_exchange_of_closed(const KernelCall<T>& call) const;
  std::ptrdiff_t place(int direction, int x, int y, int z) const;

  Populations<T> populations_;
  HaloExchange<T> halo_;
  FacePatches<T> patches_;
  std::unique_ptr<CellLabels> labels_;
  std::unique_ptr<SolidLinks<T>> links_;
  std::unique_ptr<WallLinks<T>> walls_;
  std::unique_ptr<PartialSolidStore<T>> store_;
};

}  // namespace suffuse::lbm
