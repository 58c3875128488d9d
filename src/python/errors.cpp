#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "shelfbeam/base/error.hpp"

#include "jobs/event.hpp"
#include "python/bind.hpp"

namespace py = pybind11;

namespace shelfbeam::python {

namespace {

// Names of files may have bytes that are not UTF-8, as those of Python itself.
py::object text_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
}

// The class and its attributes are those of shelfbeam/errors.py.
void raise(const std::exception& error, const std::string& kind, const std::string& where, Setting setting) {
  const jobs::JobError end = jobs::error_of(error);
  const py::object made = py::module_::import("shelfbeam.errors")
                              .attr("make")(kind, text_of(end.message), static_cast<int>(end.code),
                                            text_of(where), std::string(to_text(setting)));
  PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const OutputError& error) {
    raise(error, "output", error.where(), error.setting());
  } catch (const InputError& error) {
    raise(error, "input", error.where(), error.setting());
  } catch (const Interrupted& stop) {
    raise(stop, "interrupted", "", stop.setting());
  } catch (const std::filesystem::filesystem_error& error) {
    raise(InputError(error.path1().string(), "cannot be used (" + error.code().message() + ")",
                     "check the path"),
          "input", error.path1().string(), Setting::none);
  } catch (const std::bad_alloc& error) {
    raise(error, "memory", "", Setting::memory);
  } catch (const py::error_already_set&) {
    throw;
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::exception& error) {
    raise(error, "internal", "", Setting::none);
  }
}

}  // namespace

void bind_errors() {
  py::register_local_exception_translator(translate);  // others have their own
}

}  // namespace shelfbeam::python
