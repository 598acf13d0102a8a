file(GLOB_RECURSE spume_sources CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/spume/*.[ch]pp ${PROJECT_SOURCE_DIR}/apps/*.[ch]pp
     ${PROJECT_SOURCE_DIR}/tests/*.[ch]pp ${PROJECT_SOURCE_DIR}/bench/*.[ch]pp)
find_program(CLANG_FORMAT clang-format)
if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${spume_sources})
  add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run --Werror ${spume_sources})
else()
  add_custom_target(format COMMAND ${CMAKE_COMMAND} -E echo "make format needs the package clang-format"
                           COMMAND ${CMAKE_COMMAND} -E false)
endif()
# clang-tidy 14, Debian 12's default, does not know std::source_location of this compiler and says so; 16 does.
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy-16 run-clang-tidy-15 run-clang-tidy)
if(RUN_CLANG_TIDY)
  add_custom_target(tidy COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR}
                         "${PROJECT_SOURCE_DIR}/(spume|apps)/.*")
else()
  add_custom_target(tidy COMMAND ${CMAKE_COMMAND} -E echo "make tidy needs the package clang-tidy"
                         COMMAND ${CMAKE_COMMAND} -E false)
endif()
