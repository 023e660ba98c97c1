# Run by CPack between install and packing: what Debian wants of installed files, and what the packages need.
file(GLOB manuals ${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/man/man1/*.1)
file(GLOB changelogs ${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/doc/*/changelog*)
execute_process(COMMAND gzip -9nf ${manuals} ${changelogs} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE libraries ${CPACK_TEMPORARY_DIRECTORY}/*.a)
execute_process(COMMAND strip --strip-debug --enable-deterministic-archives --remove-section=.comment --remove-section=.note
  ${libraries} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE programs ${CPACK_TEMPORARY_DIRECTORY}/*.so* ${CPACK_TEMPORARY_DIRECTORY}/*/usr/bin/*)
execute_process(COMMAND strip --remove-section=.comment --remove-section=.note ${programs} COMMAND_ERROR_IS_FATAL ANY)

# cotan_depends(FIELD FILES...): the packages that have the libraries which the files link, as dpkg-shlibdeps names them.
function(cotan_depends field)
  set(place ${CPACK_TEMPORARY_DIRECTORY}/depends)
  file(WRITE ${place}/debian/control "Source: cotan\n\nPackage: cotan\nArchitecture: any\n")
  list(TRANSFORM ARGN PREPEND -e)
  execute_process(COMMAND dpkg-shlibdeps -O --ignore-missing-info ${ARGN} WORKING_DIRECTORY ${place}
    OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "^shlibs:Depends=(.*)\n$" "\\1" found "${found}")
  set(CPACK_DEBIAN_${field} "${found}" PARENT_SCOPE)
  file(REMOVE_RECURSE ${place})
endfunction()
set(place ${CPACK_TEMPORARY_DIRECTORY})
file(GLOB library ${place}/libcotan0/usr/lib/*.so.*.* ${place}/libcotan0/usr/lib/*/*.so.*.*)
file(GLOB_RECURSE window ${place}/cotan/*/cotan_window.so)
file(GLOB_RECURSE formats ${place}/cotan/*/cotan_image_formats.so)
# The window, and what reads pictures of further formats, are loaded when they are needed, and nothing else misses them.
cotan_depends(COTAN_PACKAGE_DEPENDS ${place}/cotan/usr/bin/cotan)
cotan_depends(LIBCOTAN0_PACKAGE_DEPENDS ${library})
if(window)
  cotan_depends(COTAN_PACKAGE_RECOMMENDS ${window})
endif()
if(formats)
  cotan_depends(COTAN_PACKAGE_SUGGESTS ${formats})
endif()
