"""A passive network in PyTorch, eager: the equations, windows and descent of train_passive_network.cpp.

PassiveTwin("PEER").is_equal() tells whether its mean square is the one that `PEER passive` prints.
"""
import subprocess

import torch

LEAST_GATE, MOST_GATE = -12, 8
RATE, DECAYS = 1e-2, (0.9, 0.99)


def mean_decay(reach):
    return torch.where(reach > 1e-2, -torch.expm1(-reach) / reach.clamp(min=1e-2), 1 - reach * (0.5 - reach / 6))


class PassiveTwin:
    def __init__(self, program, windows=32):
        lines = subprocess.run([program, "passive"], check=True, capture_output=True, text=True).stdout.splitlines()
        sizes, (self.step, self.drive_middle, self.told), numbers, *signals = [list(map(float, line.split())) for line in lines]
        self.springs, self.memories, self.neurons, self.viscous_neurons, self.run_in = map(int, sizes)
        self.x, self.v, self.q, self.force = (torch.tensor(s).repeat(windows, 1) for s in signals)
        seen = 3 + self.memories
        inputs = seen + self.springs + 1
        shapes = {"weights": (self.neurons + self.memories, inputs), "gates": (2 * self.springs, self.neurons + 2),
                  "viscous_weights": (self.viscous_neurons, seen + 1), "viscous": (self.viscous_neurons + 2,),
                  "levers": (2, self.springs), "stiffness": (self.springs,), "memory_rates": (self.memories,), "saturation": (1,),
                  "potential": (5,), "drive_rate": (1,), "inertia": (1,), "inertia_rate": (1,)}
        flat, at, self.free, self.logs = torch.tensor(numbers), 0, {}, {}
        for name, shape in shapes.items():
            count = int(torch.tensor(shape).prod())
            part = flat[at:at + count].reshape(shape)
            at += count
            if name in ("weights", "gates", "viscous_weights", "viscous"):
                self.free[name] = part.clone().requires_grad_()
            else:
                self.logs[name] = part.log().requires_grad_()
        self.descent = torch.optim.AdamW([*self.free.values(), *self.logs.values()], lr=RATE, betas=DECAYS, weight_decay=0, foreach=True)

    def forces(self):
        p = {**self.free, **{name: log.exp() for name, log in self.logs.items()}}
        count, samples = self.x.shape
        one = torch.ones(count, 1)
        share_of = lambda q: p["saturation"] * -torch.expm1(-q.clamp(min=0) / p["saturation"])
        lever_of = lambda share: p["levers"][0] + p["levers"][1] * share
        memory_kept, follower_kept = torch.exp(-p["memory_rates"] * self.step), torch.exp(-p["inertia_rate"] * self.step)
        turn, u = p["stiffness"] * self.step, p["potential"]
        spring, memory, follower = torch.zeros(count, self.springs), torch.zeros(count, self.memories), self.v[:, :1]
        forces = []
        for t in range(samples):
            # The force at a sample.
            x, v, q = self.x[:, t:t + 1], self.v[:, t:t + 1], self.q[:, t:t + 1]
            share = share_of(q)
            hidden = torch.tanh(torch.cat([v, x, q - self.drive_middle, memory, one], 1) @ p["viscous_weights"].T)
            z = torch.cat([hidden, one, share], 1) @ p["viscous"]
            force = 0.5 * (z + torch.sqrt(z * z + 1)) * v[:, 0]
            force = force + (u[0] * x + u[1] * torch.exp(u[2] * x) - u[3] * torch.exp(-u[4] * x))[:, 0]
            force = force + (p["inertia"] * (v - follower))[:, 0] + (lever_of(share) * spring).sum(1)
            forces.append(force)
            if t + 1 == samples:
                break

            # A step: memories, springs at resistances that stand still, the follower.
            x, v, q = (0.5 * (s[:, t:t + 1] + s[:, t + 1:t + 2]) for s in (self.x, self.v, self.q))
            share = share_of(q)
            sums = torch.cat([v, x, q - self.drive_middle, memory, spring, one], 1) @ p["weights"].T
            answers = torch.tanh(sums)
            hidden, goals = answers[:, :self.neurons], answers[:, self.neurons:]
            memory = goals + memory_kept * (memory - goals)
            gates = torch.exp((torch.cat([hidden, one, share], 1) @ p["gates"].T).clamp(LEAST_GATE, MOST_GATE))
            way = lever_of(share) * v
            reach = turn * (gates[:, :self.springs] + way.abs() * gates[:, self.springs:])
            spring = torch.exp(-reach) * spring + turn * way * mean_decay(reach)
            follower = v + follower_kept * (follower - v)
        return torch.stack(forces, 1)

    def cost(self):
        """Mean square over the scored samples."""
        return (self.forces() - self.force)[:, self.run_in:].square().mean()

    def is_equal(self):
        with torch.no_grad():
            return abs(float(self.cost()) / self.told - 1) < 1e-3

    def update(self):
        self.descent.zero_grad()
        self.cost().backward()
        torch.nn.utils.clip_grad_norm_([*self.free.values(), *self.logs.values()], 1)
        self.descent.step()
