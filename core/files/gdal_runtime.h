// GDAL's process-wide set-up and its error reports.
#pragma once

#include <cpl_error.h>

#include <string>
#include <vector>

namespace marsview {

/// Registers the drivers (gdal_drivers.h) and bounds GDAL's block cache, once. Any thread; cheap
/// after the first call. Silences GDAL's own printing to stderr: messages are collected by
/// GdalMessages. Settings of the user, in the environment or in GDAL's configuration file, take
/// precedence.
void ensureGdal();

/// Whether the user set a GDAL option. Call after ensureGdal().
bool hasUserOption(const char* name);

/// Collects GDAL's messages on this thread during its lifetime.
class GdalMessages {
public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    bool hasFailed() const noexcept { return !failures_.empty(); }
    /// The first failure as one line without a full stop; `otherwise` if there was none.
    std::string firstFailure(const std::string& otherwise) const;
    const std::vector<std::string>& failures() const noexcept { return failures_; }
    const std::vector<std::string>& warnings() const noexcept { return warnings_; }

private:
    static void CPL_STDCALL collect(CPLErr level, CPLErrorNum number, const char* text);

    std::vector<std::string> failures_;
    std::vector<std::string> warnings_;
};

} // namespace marsview
