# What linkers see of the library, static and shared. check_symbols.cmake looks at the objects of an instruction set.
add_test(NAME hosts.symbols COMMAND ${CMAKE_COMMAND} -DREADELF=${CMAKE_READELF} -DAR=${CMAKE_AR}
         -DINCLUDE=${PROJECT_SOURCE_DIR}/include/vndf -DLIBRARY=$<TARGET_FILE:vndf>
         -P ${CMAKE_CURRENT_SOURCE_DIR}/check_exports.cmake)
add_test(NAME hosts.symbols.shared COMMAND ${CMAKE_COMMAND} -DREADELF=${CMAKE_READELF} -DAR=${CMAKE_AR}
         -DINCLUDE=${PROJECT_SOURCE_DIR}/include/vndf "-DLIBRARY=${all_sorts}/build/libvndf.so"
         -P ${CMAKE_CURRENT_SOURCE_DIR}/check_exports.cmake)
set_tests_properties(hosts.symbols.shared PROPERTIES FIXTURES_REQUIRED vndf_shared)
