# OpenCV::<module> for the named components. Debian's OpenCVConfig.cmake comes with all of OpenCV, VTK and Qt among it;
# this finds the few modules that are used.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
foreach(module IN LISTS OpenCVModules_FIND_COMPONENTS)
  find_library(OPENCV_${module}_LIBRARY opencv_${module})
  if(OPENCV_${module}_LIBRARY AND OPENCV_INCLUDE_DIR)
    set(OpenCVModules_${module}_FOUND TRUE)
    if(NOT TARGET OpenCV::${module})
      add_library(OpenCV::${module} UNKNOWN IMPORTED)
      set_target_properties(OpenCV::${module} PROPERTIES
        IMPORTED_LOCATION ${OPENCV_${module}_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE_DIR})
    endif()
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVModules REQUIRED_VARS OPENCV_INCLUDE_DIR HANDLE_COMPONENTS)
mark_as_advanced(OPENCV_INCLUDE_DIR)
