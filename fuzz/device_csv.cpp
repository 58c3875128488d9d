#include "shelfbeam/scene/store/store_parts.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

Store with_types() {
  Store store;
  store.label_types.emplace_back().name = "standard";
  store.transceiver_types.emplace_back().name = "ceiling";
  return store;
}

// Reads labels or units, which differ in their headers.
void fuzz_device_csv(std::string_view bytes) {
  static const Store types = with_types();
  Store store = types;
  const std::filesystem::path file = scratch().write("devices.csv", bytes);
  if (bytes.find("ax") == std::string_view::npos)
    read_labels_csv({InputFile(file)}, StoreNames(store), store);
  else
    read_transceivers_csv({InputFile(file)}, StoreNames(store), store);
}

std::vector<std::string> device_csv_seeds() {
  return {
      "id,x,y,z,nx,ny,nz,type,note,name\nP,5,0.01,1.5,0,1,0,standard,x,Offers\n\"Q, "
      "1\",1,2,3,1e-300,0,-1,standard\n",
      "id;x;y;z;nx;ny;nz;type\r\nP;5;0,01;1,5;0;1;0;standard\r\n",
      "ID,X,Y,Z,NX,NY,NZ,Type\n4.00638E+12,5,0.01,1.5,0,1,0,standard\n1.0,5,0.01,1.5,0,1,0,standard\n",
      "id,x,y,z,ax,ay,az,roll_deg,type,cost\ntill,6,5,2.9,0,0,-1,90,ceiling,1\n"};
}

}  // namespace

extern const Reader device_csv;
const Reader device_csv{"device_csv", fuzz_device_csv, device_csv_seeds};

}  // namespace shelfbeam::fuzz
