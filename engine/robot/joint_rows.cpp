#include "engine/robot/joint_rows.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "engine/core/check.h"

namespace pedicel::robot {

JointRows::JointRows(btMultiBody* body, std::vector<Row> rows)
    : btMultiBodyConstraint(body, body, 0, 0, static_cast<int>(rows.size()), false,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      rows_(std::move(rows)) {
  PEDICEL_ASSERT(body->getLinkCollider(0) != nullptr);
  finalizeMultiDof();
}

void JointRows::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    btScalar* jacobian = jacobianA(static_cast<int>(i));
    jacobian[6 + m_bodyA->getLink(row.link).m_dofOffset] = row.coefficient;
    if (row.link_b >= 0) jacobian[6 + m_bodyA->getLink(row.link_b).m_dofOffset] = row.coefficient_b;
  }
  m_numDofsFinalized = m_jacSizeBoth;
}

int JointRows::getIslandIdA() const {
  return m_bodyA->getLinkCollider(0)->getIslandTag();
}

void JointRows::createConstraintRows(btMultiBodyConstraintArray& constraint_rows,
                                     btMultiBodyJacobianData& data,
                                     const btContactSolverInfo& info) {
  const btVector3 zero(0, 0, 0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const int index = static_cast<int>(i);
    internalSetAppliedImpulse(index, 0.0);
    if (!row.active) continue;
    btMultiBodySolverConstraint& solver = constraint_rows.expandNonInitializing();
    fillMultiBodyConstraint(solver, data, jacobianA(index), jacobianB(index), zero, zero, zero,
                            zero, 0.0, info, row.lower, row.upper, false, 1.0, false, row.target);
    // Bullet's iteration is delta = rhs - applied * cfm - (J dv) * inverse, with rhs and cfm
    // already multiplied by the inverse of J M^-1 J^T (+ softness).
    const double inverse = solver.m_jacDiagABInv;
    const double softened = inverse / (1.0 + row.softness * inverse);
    solver.m_rhs *= softened / inverse;
    solver.m_jacDiagABInv = softened;
    solver.m_cfm = row.softness * softened;
    solver.m_orgConstraint = this;
    solver.m_orgDofIndex = index;
    // No Cartesian direction: the reaction is internal to the joint.
    solver.m_relpos1CrossNormal = solver.m_relpos2CrossNormal = zero;
    solver.m_contactNormal1 = solver.m_contactNormal2 = zero;
  }
}

}  // namespace pedicel::robot
