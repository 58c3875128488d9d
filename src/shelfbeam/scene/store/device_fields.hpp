#pragma once

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

// The keys of labels, units and candidates in the store file.

/// What the values of types refer to, for the reader.
struct TypeSource {
  const Store& store;
  const StoreNames& names;
  const StoreFolder& folder;
  const Problems& problems;
};

/// `wavelength_nm` is that of the store, for the reader.
void describe(NamedMaterial& named, Fields& f, double wavelength_nm = 940);
void describe(LabelType& type, Fields& f, const TypeSource* source = nullptr);
void describe(TransceiverType& type, Fields& f, const TypeSource* source = nullptr);
void describe(Label& label, Fields& f);
void describe(Transceiver& unit, Fields& f);
void describe(TransceiverGrid& grid, Fields& f);
void describe(MountArea& mount, Fields& f);
void describe(MountRail& rail, Fields& f);
void describe(MountFaces& mount, Fields& f);
void describe(KeepOut& area, Fields& f);
void describe(MeasuringPlane& plane, Fields& f);

}  // namespace shelfbeam
