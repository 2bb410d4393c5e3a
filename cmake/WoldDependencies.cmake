# Libraries from outside. `tools/install_dependencies` installs what is missing on Debian.

find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(embree 3.12 QUIET)
if(NOT embree_FOUND)
  find_package(embree 4 REQUIRED)
endif()
find_package(PkgConfig REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(HIGHWAY REQUIRED IMPORTED_TARGET libhwy)
# By pkg-config: Debian's CMake package of OpenImageIO also wants its command-line tools.
pkg_check_modules(OPENIMAGEIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
# Real time. epoxy and GLFW find the drivers when the program runs: nothing here links to them.
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(GLFW REQUIRED IMPORTED_TARGET glfw3)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
find_path(WOLD_TINYGLTF_INCLUDE tiny_gltf.h PATH_SUFFIXES tinygltf REQUIRED)
find_library(WOLD_TINYGLTF_LIBRARY tinygltf REQUIRED)

# Optional: real elevation data (.hgt, GeoTIFF).
pkg_check_modules(GDAL IMPORTED_TARGET gdal)
add_library(wold_gdal INTERFACE)
if(GDAL_FOUND)
  target_compile_definitions(wold_gdal INTERFACE WOLD_GDAL)
  target_link_libraries(wold_gdal INTERFACE PkgConfig::GDAL)
else()
  message(NOTICE "GDAL was not found: wold will not read elevation data such as .hgt and GeoTIFF.")
endif()

add_library(wold_highway INTERFACE)
target_link_libraries(wold_highway INTERFACE PkgConfig::HIGHWAY)

add_library(wold_embree INTERFACE)
target_link_libraries(wold_embree INTERFACE embree)

add_library(wold_tinygltf INTERFACE)
target_include_directories(wold_tinygltf SYSTEM INTERFACE ${WOLD_TINYGLTF_INCLUDE})
target_link_libraries(wold_tinygltf INTERFACE ${WOLD_TINYGLTF_LIBRARY})

add_library(wold_imgui INTERFACE)
target_link_libraries(wold_imgui INTERFACE PkgConfig::IMGUI)
