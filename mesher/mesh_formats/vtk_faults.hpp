// The faults that VTK reports, taken instead of printed.
#pragma once

#include <vtkCommand.h>
#include <vtkLogger.h>
#include <vtkOutputWindow.h>

#include <string>

namespace cbc3d {

/// VTK reports faults through observers, not exceptions.
class VtkFaults : public vtkCommand {
 public:
  static VtkFaults* New() { return new VtkFaults; }
  void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
    if (text.empty() && data != nullptr) {
      text = static_cast<const char*>(data);
    }
  }
  std::string text;  ///< of the first fault
};

/// Some of VTK's readers report a file that ends too early to VTK's window of messages alone, which this
/// takes the place of.
class VtkWindow : public vtkOutputWindow {
 public:
  static VtkWindow* New() { return new VtkWindow; }
  void DisplayText(const char* /*text*/) override {}
  void DisplayErrorText(const char* /*text*/) override { faulty = true; }
  void DisplayGenericWarningText(const char* /*text*/) override { faulty = true; }
  bool faulty = false;
};

/// VTK also prints its faults itself, in many lines; this silences it, so that the user gets our one
/// line.
class VtkSilence {
 public:
  VtkSilence() : before_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~VtkSilence() { vtkLogger::SetStderrVerbosity(before_); }
  VtkSilence(const VtkSilence&) = delete;
  VtkSilence& operator=(const VtkSilence&) = delete;

 private:
  vtkLogger::Verbosity before_;
};

}  // namespace cbc3d
