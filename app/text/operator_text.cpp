#include "app/text/operator_text.h"

#include <QCoreApplication>
#include <QStringList>

namespace zerodrift {

using controller::OperatorAct;
using controller::OperatorRequest;

namespace {

struct OperatorText {
  Q_DECLARE_TR_FUNCTIONS(zerodrift::OperatorText)
};

}  // namespace

QString operatorText(const OperatorRequest& request, const QLocale& locale) {
  const QString spindle = (request.coolant_on ? OperatorText::tr("spindle %1 rpm, coolant on")
                                              : OperatorText::tr("spindle %1 rpm, coolant off"))
                              .arg(locale.toString(request.spindle_rpm, 'f', 0));
  switch (request.act) {
    case OperatorAct::state:
      return OperatorText::tr("Is the compensation switched on at the control?");
    case OperatorAct::command:
      return (request.path_cycle ? OperatorText::tr("Set %1, and start the warm-up path")
                                 : OperatorText::tr("Set %1, no warm-up path"))
          .arg(spindle);
    case OperatorAct::move: {
      QStringList target;
      for (const auto& [axis, position_mm] : request.target_mm) {
        target << QStringLiteral("%1 %2").arg(QString::fromStdString(axis), locale.toString(position_mm, 'f', 3));
      }
      return OperatorText::tr("Stop the path and move to %1 mm (%2)").arg(target.join(QStringLiteral("  ")), spindle);
    }
    case OperatorAct::switch_compensation:
      return request.compensation_on ? OperatorText::tr("Switch the compensation on")
                                     : OperatorText::tr("Switch the compensation off");
    case OperatorAct::offset:
      return OperatorText::tr("Enter a test offset of X %1, Y %2, Z %3 um")
          .arg(request.offset_um[0])
          .arg(request.offset_um[1])
          .arg(request.offset_um[2]);
    case OperatorAct::load_table:
      return OperatorText::tr("Load the table %1 into the control, then type the check value that it shows")
          .arg(QString::fromStdString(request.file));
    case OperatorAct::check_table:
      return OperatorText::tr("Type the check value that the control shows for its table");
  }
  return {};
}

}  // namespace zerodrift
