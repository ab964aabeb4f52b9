#pragma once

namespace clatter {

/// A shared library opened at run time. The program starts even if the library is not installed.
class Library {
 public:
  /// Opens the library `name`. Throws RunError with the reason and the Debian `package` to install.
  Library(const char* name, const char* package);

  /// The address of an exported function as pointer type F. Throws RunError if it is missing.
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
