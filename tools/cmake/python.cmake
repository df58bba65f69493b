# The packages of the Python module (app/python). It is for the system's own Python, which is not
# always the first on the path; -DPEDICEL_PYTHON_EXECUTABLE=FILE takes another one.
set(PEDICEL_PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module is for")
# A sanitizer's runtime must be there first, which a plain Python does not see to.
if(PEDICEL_SANITIZE OR PEDICEL_TSAN OR PEDICEL_FUZZ)
  set(PEDICEL_PYTHON OFF)
endif()
if(NOT PEDICEL_PYTHON)
  return()
endif()

set(PYBIND11_FINDPYTHON ON)
set(Python_EXECUTABLE ${PEDICEL_PYTHON_EXECUTABLE})
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
find_package(pybind11 2.10 CONFIG QUIET)
if(NOT Python_FOUND OR NOT pybind11_FOUND)
  message(STATUS "No Python module: it needs python3-dev, python3-numpy and pybind11-dev")
  set(PEDICEL_PYTHON OFF)
endif()
