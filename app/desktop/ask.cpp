#include "app/desktop/ask.h"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>

namespace zerodrift::desktop {

bool ask(QWidget* parent, const QString& heading, const QString& text, const QString& deed) {
  return askWithDetails(parent, heading, text, deed, {});
}

bool askWithDetails(QWidget* parent, const QString& heading, const QString& text, const QString& deed,
                    const QString& details) {
  QMessageBox box(QMessageBox::NoIcon, heading, heading, QMessageBox::Cancel, parent);
  box.button(QMessageBox::Cancel)->setText(QCoreApplication::translate("ask", "Cancel"));
  box.setInformativeText(text);
  if (!details.isEmpty()) box.setDetailedText(details);
  const auto* agree = box.addButton(deed, QMessageBox::AcceptRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.setEscapeButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == agree;
}

Answer ask(QWidget* parent, const QString& heading, const QString& text, const QString& deed, const QString& other) {
  QMessageBox box(QMessageBox::NoIcon, heading, heading, QMessageBox::Cancel, parent);
  box.setInformativeText(text);
  const auto* agree = box.addButton(deed, QMessageBox::AcceptRole);
  const auto* second = box.addButton(other, QMessageBox::ActionRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.setEscapeButton(QMessageBox::Cancel);
  box.exec();
  if (box.clickedButton() == agree) return Answer::yes;
  return box.clickedButton() == second ? Answer::other : Answer::no;
}

}  // namespace zerodrift::desktop
