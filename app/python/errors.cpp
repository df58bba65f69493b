#include "app/python/errors.h"

#include <pybind11/stl.h>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/render/image.h"

namespace pedicel::python {

namespace {

namespace py = pybind11;

py::object error_class(const char* name) {
  return py::module_::import("pedicel.errors").attr(name);
}

void raise(const char* name, const std::string& what) {
  const py::object type = error_class(name);
  PyErr_SetObject(type.ptr(), type(what).ptr());
}

void raise(const InvalidFile& fault) {
  const py::object type = error_class("InvalidFile");
  PyErr_SetObject(type.ptr(), type(fault.what(), diagnostics_list(fault.all())).ptr());
}

void translate(std::exception_ptr exception) {
  try {
    std::rethrow_exception(std::move(exception));
  } catch (const InvalidFile& fault) {
    raise(fault);
  } catch (const UsageError& fault) {
    raise("UsageError", fault.what());
  } catch (const Unstable& fault) {
    raise("Unstable", fault.what());
  } catch (const io::WriteError& fault) {
    raise("WriteError", fault.what());
  } catch (const render::OutputError& fault) {
    raise("WriteError", fault.what());
  } catch (const NoPictures& fault) {
    raise("NoPictures", fault.what());
  }
}

}  // namespace

py::list diagnostics_list(const std::vector<Diagnostic>& all) {
  constexpr const char* words[] = {"notice", "warning", "error"};
  const py::object type = error_class("Diagnostic");
  py::list list;
  for (const Diagnostic& one : all)
    list.append(type(words[static_cast<int>(one.severity)], one.where.file, one.where.line,
                     one.where.column, one.what));
  return list;
}

void add_errors() {
  py::register_exception_translator(translate);
}

}  // namespace pedicel::python
