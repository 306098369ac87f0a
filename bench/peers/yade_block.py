# Yade: a cube of N³ bonded spheres of diameter 1, 18 neighbours each, one face held, the opposite one pulled.
# Cohesive frictional bonds with moments, total form. Prints "RATE particle-steps/s ..." and "BYTES a particle".
import os
import resource
import time

from yade import *

N, steps, repeats = int(os.environ["N"]), int(os.environ["STEPS"]), int(os.environ["REPEATS"])
reach = 1.45  # of a diameter: axial neighbours at 1, diagonal ones at 1.41

material = O.materials.append(
    CohFrictMat(young=1e6, poisson=0.3, density=1000, frictionAngle=0.5, isCohesive=True, normalCohesion=1e12,
                shearCohesion=1e12, momentRotationLaw=True, alphaKr=1, alphaKtw=1, etaRoll=-1, etaTwist=-1))
for i in range(N):
    for j in range(N):
        for k in range(N):
            body = utils.sphere((i, j, k), 0.5, material=material)
            if i == 0:
                body.state.blockedDOFs = "xyzXYZ"
            O.bodies.append(body)
for i in range((N - 1) * N * N, N**3):
    O.forces.setPermF(i, (1e-3, 0, 0))

bounds = Bo1_Sphere_Aabb(aabbEnlargeFactor=reach)
geometry = Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=reach)
bonds = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=False)
law = Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=False)
O.engines = [ForceResetter(), InsertionSortCollider([bounds], verletDist=0.1),
             InteractionLoop([geometry], [bonds], [law]), NewtonIntegrator(damping=0.0)]
O.dt = 1e-4
O.step()  # makes the bonds; from here on no new neighbours
bounds.aabbEnlargeFactor = geometry.interactionDetectionFactor = 1.0
for i in O.interactions:
    i.phys.unp = i.geom.penetrationDepth
O.run(10, True)
rates = []
for _ in range(repeats):
    begin = time.time()
    O.run(steps, True)
    rates.append(N**3 * steps / (time.time() - begin))
print("RATE", *rates)
print("BONDS", O.interactions.countReal())
print("BYTES", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / N**3)
