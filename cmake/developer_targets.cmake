file(GLOB_RECURSE spume_sources CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/spume/*.[ch]pp ${PROJECT_SOURCE_DIR}/apps/*.[ch]pp
     ${PROJECT_SOURCE_DIR}/tests/*.[ch]pp ${PROJECT_SOURCE_DIR}/bench/*.[ch]pp)
find_program(CLANG_FORMAT clang-format)
if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${spume_sources})
  add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run --Werror ${spume_sources})
endif()
find_program(RUN_CLANG_TIDY run-clang-tidy)
if(RUN_CLANG_TIDY)
  add_custom_target(tidy COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR} "${PROJECT_SOURCE_DIR}/spume/.*")
endif()
