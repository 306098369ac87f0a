# ESyS-Particle: a cube of N³ bonded spheres of diameter 1, 18 neighbours each, brittle beams.
# Prints "RATE particle-steps/s" of the time loop.
import os
import time

from esys.lsm import *
from esys.lsm.geometry import *
from esys.lsm.util import *

N, workers, steps = int(os.environ["N"]), int(os.environ["WORKERS"]), int(os.environ["STEPS"])
warm = 10

sim = LsmMpi(numWorkerProcesses=workers, mpiDimList=[workers, 1, 1])
sim.initNeighbourSearch(particleType="RotSphere", gridSpacing=2.2, verletDist=0.5)
sim.setNumTimeSteps(steps + warm + 1)
sim.setTimeStepSize(1e-4)
sim.setSpatialDomain(BoundingBox(Vec3(-3, -3, -3), Vec3(N + 3, N + 3, N + 3)))
block = SimpleBlock([N, N, N], 0.5)
sim.createParticles(block)
sim.createConnections(ConnectionFinder(maxDist=0.45, bondTag=1, pList=block))
sim.createInteractionGroup(
    BrittleBeamPrms(name="bonds", youngsModulus=1e4, poissonsRatio=0.25, cohesion=1e9, tanAngle=1.0, tag=1))


class Clock(Runnable):
    def __init__(self):
        Runnable.__init__(self)

    def run(self):
        if sim.getTimeStep() == warm:
            self.begin = time.time()
        if sim.getTimeStep() == warm + steps:
            print("RATE", N**3 * steps / (time.time() - self.begin), flush=True)


clock = Clock()
sim.addPreTimeStepRunnable(clock)
sim.run()
