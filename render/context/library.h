#pragma once

namespace clatter {

/// A shared library opened at run time, so that the program starts where it is not installed.
class Library {
 public:
  /// Opens `name`; throws RunError that says why it cannot and names the Debian `package` to
  /// install.
  Library(const char* name, const char* package);

  /// The address of an exported function, as pointer type F; throws RunError where there is none.
  template <class F>
  F function(const char* symbol) const {
    return reinterpret_cast<F>(address(symbol));
  }

 private:
  void* address(const char* symbol) const;

  const char* name_;
  void* handle_;
};

}  // namespace clatter
