# frangia_web(<folder> <output.cpp>): builds the front end in a folder by npm and writes a source that holds its files.
#
# The packages of package-lock.json are installed once, by `npm ci`; later builds need no network. node_modules and the
# built files are in the build tree, so that the source tree stays clean.
# FRANGIA_WEB_DIST names a front end that is built already, as the source distribution for pip holds it; then node and npm
# are not needed.
set(FRANGIA_WEB_DIST "" CACHE PATH "Folder of a front end that is built already")
function(frangia_web folder output)
  if(FRANGIA_WEB_DIST)
    find_package(Python3 COMPONENTS Interpreter REQUIRED)
    file(GLOB_RECURSE built CONFIGURE_DEPENDS ${FRANGIA_WEB_DIST}/*)
    if(NOT built)
      message(FATAL_ERROR "FRANGIA_WEB_DIST is ${FRANGIA_WEB_DIST}, which holds no files")
    endif()
    add_custom_command(OUTPUT ${output}
      COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/cmake/embed_web.py embed ${FRANGIA_WEB_DIST} ${output}
      DEPENDS ${built} ${PROJECT_SOURCE_DIR}/cmake/embed_web.py
      COMMENT "Embedding the front end" VERBATIM)
    add_custom_target(frangia_web DEPENDS ${output})
    return()
  endif()
  find_program(NPM npm)
  find_program(NODE node)
  if(NOT NPM OR NOT NODE)
    message(FATAL_ERROR "the operator's app needs node and npm: apt-get install nodejs npm, or configure with -DFRANGIA_APP=OFF")
  endif()
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  set(tree ${PROJECT_BINARY_DIR}/web)
  set(schema ${PROJECT_SOURCE_DIR}/docs/service-schema.json)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/src/* ${folder}/public/*)
  list(APPEND sources ${folder}/index.html ${folder}/vite.config.ts ${folder}/tsconfig.json)
  add_custom_command(OUTPUT ${tree}/installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${tree}
    COMMAND ${CMAKE_COMMAND} -E copy ${folder}/package.json ${folder}/package-lock.json ${folder}/.npmrc ${tree}
    COMMAND ${CMAKE_COMMAND} -E chdir ${tree} ${NPM} ci --silent --prefer-offline
    COMMAND ${CMAKE_COMMAND} -E touch ${tree}/installed
    DEPENDS ${folder}/package.json ${folder}/package-lock.json
    COMMENT "Installing the packages of the front end" VERBATIM)
  add_custom_command(OUTPUT ${output}
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/cmake/embed_web.py build ${folder} ${tree} ${NODE} ${schema}
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/cmake/embed_web.py embed ${tree}/dist ${output}
    DEPENDS ${tree}/installed ${sources} ${PROJECT_SOURCE_DIR}/cmake/embed_web.py ${schema}
      ${PROJECT_SOURCE_DIR}/tools/schema_types.py
    COMMENT "Building the front end" VERBATIM)
  add_custom_target(frangia_web DEPENDS ${output})  # beside the compilation of the modules, not after it
endfunction()
