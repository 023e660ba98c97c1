# Run by CPack between install and packing: Debian's rules for installed files, and the packages' dependencies.
cmake_policy(VERSION 3.25)
set(place ${CPACK_TEMPORARY_DIRECTORY})
unset(CPACK_PACKAGE_DESCRIPTION_SUMMARY) # each package has its own

file(GLOB manuals ${place}/*/usr/share/man/man1/*.1)
file(GLOB changelogs ${place}/*/usr/share/doc/*/changelog*)
execute_process(COMMAND gzip -9nf ${manuals} ${changelogs} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE archives ${place}/*.a)
execute_process(COMMAND strip --strip-debug --enable-deterministic-archives --remove-section=.comment
  --remove-section=.note ${archives} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE library ${place}/libcotan0/*.so.*.*)
file(GLOB_RECURSE window ${place}/cotan/*/cotan_window.so)
file(GLOB_RECURSE formats ${place}/cotan/*/cotan_image_formats.so)
set(tool ${place}/cotan/usr/bin/cotan)
execute_process(COMMAND strip --remove-section=.comment --remove-section=.note ${tool} ${library} ${window} ${formats}
  COMMAND_ERROR_IS_FATAL ANY)

# cotan_needs(RESULT KNOWN FILES...): the packages of the libraries that the files link, by dpkg-shlibdeps, except those
# that KNOWN names.
function(cotan_needs result known)
  set(packages "")
  if(ARGN)
    set(source ${place}/needs)
    file(WRITE ${source}/debian/control "Source: cotan\n\nPackage: cotan\nArchitecture: any\n")
    list(TRANSFORM ARGN PREPEND -e)
    execute_process(COMMAND dpkg-shlibdeps -O ${ARGN} WORKING_DIRECTORY ${source} OUTPUT_VARIABLE found
      ERROR_VARIABLE problem RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "${problem}")
    endif()
    file(REMOVE_RECURSE ${source})
    string(REGEX REPLACE "^shlibs:Depends=(.*)\n$" "\\1" found "${found}")
    string(REPLACE ", " ";" found "${found}")
    string(REPLACE ", " ";" known "${known}")
    list(TRANSFORM known REPLACE " .*" "")
    foreach(package ${found})
      string(REGEX REPLACE " .*" "" name "${package}")
      if(NOT name IN_LIST known)
        list(APPEND packages ${package})
      endif()
    endforeach()
  endif()
  list(JOIN packages ", " packages)
  set(${result} "${packages}" PARENT_SCOPE)
endfunction()
cotan_needs(CPACK_DEBIAN_LIBCOTAN0_PACKAGE_DEPENDS "" ${library})
cotan_needs(CPACK_DEBIAN_COTAN_PACKAGE_DEPENDS "" ${tool})
# The window and the reader of further image formats are modules that are loaded on demand; the rest works without them.
cotan_needs(CPACK_DEBIAN_COTAN_PACKAGE_RECOMMENDS "${CPACK_DEBIAN_COTAN_PACKAGE_DEPENDS}" ${window})
cotan_needs(CPACK_DEBIAN_COTAN_PACKAGE_SUGGESTS "${CPACK_DEBIAN_COTAN_PACKAGE_DEPENDS}" ${formats})
