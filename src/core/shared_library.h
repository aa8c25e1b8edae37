// Libraries that are loaded when they are first needed.
#pragma once

#include <string>

/// For tables of a library's functions, FUNCTIONS(X) being X(its name) for each: a struct `table`
/// has the members FUNCTIONS(CAROM_FUNCTION), which FUNCTIONS(CAROM_FIND) fills from `library`.
#define CAROM_FUNCTION(name) decltype(&::name) name = nullptr;
#define CAROM_FIND(name) library.find(table.name, #name);

namespace carom {

/// Stays loaded until the process ends: its functions may be called until then.
class SharedLibrary {
  public:
    /// `file`: such as "libOSMesa.so.8"; `need`: who needs what, for messages: "pictures need
    /// OSMesa". Failure(kRun) with the loader's own text if it cannot be loaded.
    SharedLibrary(std::string file, std::string need);

    /// Fills a pointer to the function of that name. Failure(kRun) if there is none.
    template <class Function>
    void find(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(address(name));
    }

    /// Where it was found, without a slash at its end; "" where the system does not tell.
    std::string folder() const;

    /// Loads a library ahead of those who need it. The loader's own text where that fails, else "".
    static std::string try_to_load(const std::string& file);

  private:
    void* address(const char* name) const;

    std::string file_, need_;
    void* handle_;
};

}  // namespace carom
