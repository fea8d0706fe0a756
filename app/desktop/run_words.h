#pragma once
// Names and words of a run's channels.

#include <QString>
#include <cmath>
#include <string>

#include "ui/pages/run_view.h"

namespace zerodrift::desktop {

/// A channel as the run's plots and tables show it.
ui::RunChannel channel_of(const std::string& name, const QString& label);

/// The channel with the standard uncertainty of an error: sigma_X_nm of dX_um; none of the others.
inline std::string sigma_channel(const std::string& error) {
  const bool known = error.size() > 4 && error.front() == 'd' && error.ends_with("_um");
  return known ? "sigma_" + error.substr(1, error.size() - 4) + "_nm" : std::string("-");
}

inline QString uncertainty_text(double sigma_nm) {
  return std::isnan(sigma_nm) ? QString() : QStringLiteral("± %1 µm").arg(sigma_nm / 1000.0, 0, 'f', 2);
}

}  // namespace zerodrift::desktop
