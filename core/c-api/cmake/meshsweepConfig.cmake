# find_package(meshsweep CONFIG PATHS <the archive's folder>), then
# target_link_libraries(firmware PRIVATE meshsweep::meshsweep).
#
# meshsweep::small is the same, compiled for size; archives for workstations have no such library.

get_filename_component(_meshsweep "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

foreach(_name meshsweep small)
  set(_file "${_meshsweep}/lib/libmeshsweep.a")
  if(_name STREQUAL "small")
    set(_file "${_meshsweep}/lib/libmeshsweep_small.a")
  endif()
  if(EXISTS "${_file}" AND NOT TARGET meshsweep::${_name})
    add_library(meshsweep::${_name} STATIC IMPORTED GLOBAL)
    set_target_properties(meshsweep::${_name} PROPERTIES
      IMPORTED_LOCATION "${_file}"
      INTERFACE_INCLUDE_DIRECTORIES "${_meshsweep}/include")
  endif()
endforeach()

if(NOT TARGET meshsweep::meshsweep)
  set(meshsweep_FOUND FALSE)
  set(meshsweep_NOT_FOUND_MESSAGE "no lib/libmeshsweep.a: take an archive of `cargo xtask dist`")
endif()

unset(_meshsweep)
unset(_file)
unset(_name)
