#include "app/desktop/ask.h"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>

namespace zerodrift::desktop {

bool ask(QWidget* parent, const QString& heading, const QString& text, const QString& deed) {
  QMessageBox box(QMessageBox::NoIcon, heading, heading, QMessageBox::Cancel, parent);
  box.button(QMessageBox::Cancel)->setText(QCoreApplication::translate("ask", "Cancel"));
  box.setInformativeText(text);
  const auto* agree = box.addButton(deed, QMessageBox::AcceptRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.setEscapeButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == agree;
}

}  // namespace zerodrift::desktop
