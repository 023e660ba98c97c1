# Where Cotan is published: COTAN_REPOSITORY (a URL) and COTAN_EMAIL, both empty while CITATION.cff names none. Everything
# that names them is made from these two, or from scripts/contact.
foreach(what repository email)
  string(TOUPPER "COTAN_${what}" variable)
  set(${variable} "")
  if(UNIX)
    execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/../scripts/contact ${what} OUTPUT_VARIABLE ${variable}
      OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/../CITATION.cff)
# Debian requires a maintainer with an address. The domain .invalid is reserved for addresses that do not exist.
set(COTAN_MAINTAINER "Unpublished build of Cotan <nobody@cotan.invalid>")
if(COTAN_EMAIL)
  set(COTAN_MAINTAINER "The Cotan authors <${COTAN_EMAIL}>")
endif()
# Lines for Debian's copyright file and for the metadata of the Python package.
set(COTAN_SOURCE_LINE "")
set(COTAN_PROJECT_URL_LINE "")
if(COTAN_REPOSITORY)
  set(COTAN_SOURCE_LINE "Source: ${COTAN_REPOSITORY}\n")
  set(COTAN_PROJECT_URL_LINE "Project-URL: Repository, ${COTAN_REPOSITORY}\n")
endif()
