// Reconstructs a scan folder and writes the mesh: scan_to_mesh SCAN MESH
#include <exception>
#include <iostream>

#include <frangia/dataset/scan_folder.h>
#include <frangia/files/write_mesh.h>
#include <frangia/reconstruct/reconstruct.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: scan_to_mesh SCAN MESH\n";
    return 2;
  }
  try {
    // The library never prints: what the user should know arrives here.
    frangia::Run run;
    run.on_warning = [](const std::string& sentence) { std::cerr << sentence << '\n'; };

    const frangia::Scan scan = frangia::read_scan(argv[1], run);
    const frangia::Reconstruction result = frangia::reconstruct(scan, {}, run);
    frangia::write_mesh(argv[2], result.mesh);
    std::cout << result.mesh.triangles.size() << " triangles from " << result.points << " points\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
