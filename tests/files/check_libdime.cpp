// Reads a DXF with libdime, which checks group codes and 16-bit indices strictly, and prints the
// number of its faces and their extents: "FACES LOW_X LOW_Y LOW_Z HIGH_X HIGH_Y HIGH_Z".
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>

#include <dime/Input.h>
#include <dime/Model.h>
#include <dime/State.h>
#include <dime/entities/3DFace.h>
#include <dime/entities/Polyline.h>
#include <dime/entities/Vertex.h>

namespace {

struct Findings {
  int faces = 0;
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

[[noreturn]] void refuse(const char* why) {
  throw std::runtime_error(why);
}

void add(Findings& found, const dimeVec3f& place) {
  const std::array<double, 3> axes{place.x, place.y, place.z};
  for (std::size_t i = 0; i < 3; ++i) {
    found.low[i] = std::min(found.low[i], axes[i]);
    found.high[i] = std::max(found.high[i], axes[i]);
  }
}

void add_polyface(Findings& found, dimePolyline& mesh) {
  if (mesh.getType() != dimePolyline::POLYFACE_MESH) refuse("a POLYLINE is not a polyface mesh");
  const int vertices = mesh.getNumCoordVertices();
  if (mesh.getPolymeshCountM() != vertices) refuse("the number of vertices differs from group 71");
  if (mesh.getPolymeshCountN() != mesh.getNumIndexVertices()) {
    refuse("the number of faces differs from group 72");
  }
  for (int i = 0; i < mesh.getNumIndexVertices(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const int index = mesh.getIndexVertex(i)->getIndex(corner);
      if (index < 1 || index > vertices) refuse("a face refers to a vertex that does not exist");
      add(found, mesh.getCoordVertex(index - 1)->getCoords());
    }
    ++found.faces;
  }
}

bool visit(const dimeState* /*state*/, dimeEntity* entity, void* data) {
  auto& found = *static_cast<Findings*>(data);
  if (entity->typeId() == dimeBase::dime3DFaceType) {
    auto* face = static_cast<dime3DFace*>(entity);
    for (int corner = 0; corner < 4; ++corner)
      add(found, face->getVertex(corner));
    ++found.faces;
  } else if (entity->typeId() == dimeBase::dimePolylineType) {
    add_polyface(found, *static_cast<dimePolyline*>(entity));
  } else {
    refuse("an entity is neither 3DFACE nor POLYLINE");
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) refuse("name one DXF file");
  dimeInput input;
  dimeModel model;
  if (!input.setFile(argv[1])) refuse("the file cannot be opened");
  if (!model.read(&input)) refuse("the file is not a DXF");
  Findings found;
  found.low.fill(std::numeric_limits<double>::max());
  found.high.fill(std::numeric_limits<double>::lowest());
  model.traverseEntities(visit, &found);
  std::printf("%d", found.faces);
  for (const auto& corner : {found.low, found.high})
    std::printf(" %.4f %.4f %.4f", corner[0], corner[1], corner[2]);
  std::printf("\n");
  return 0;
} catch (const std::exception& refusal) {
  std::fprintf(stderr, "libdime: %s\n", refusal.what());
  return 1;
}
