# A Python that has what the report is made with: the first one in PATH may be another than the
# one that the system's packages serve.
find_package(Python3 QUIET COMPONENTS Interpreter)
set(VNDF_PYTHON "" CACHE FILEPATH "Python 3 with matplotlib, pandas and Jinja2, for reports")
if(NOT VNDF_PYTHON)
  foreach(python IN ITEMS ${Python3_EXECUTABLE} /usr/bin/python3)
    execute_process(COMMAND ${python} -c "import jinja2, matplotlib, pandas"
                    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      set_property(CACHE VNDF_PYTHON PROPERTY VALUE ${python})
      break()
    endif()
  endforeach()
endif()
