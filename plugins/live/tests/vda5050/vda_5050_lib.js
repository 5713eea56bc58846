// Both sides of VDA 5050 by the npm package vda-5050-lib (MIT), for test_vda_5050_lib.py.
//
//   node vda_5050_lib.js master URL ORDERS        sends three vehicles on round trips, and prints what came of it as JSON
//   node vda_5050_lib.js vehicles URL X,Y,THETA …  has virtual vehicles at places on the map L1 until it is ended
"use strict";
const lib = require("vda-5050-lib");

const [role, brokerUrl, ...rest] = process.argv.slice(2);
const options = { interfaceName: "uagv", transport: { brokerUrl }, vdaVersion: "2.0.0" };
const FACTSHEET = {
    typeSpecification: {
        seriesName: "virtual", agvKinematic: "DIFF", agvClass: "CARRIER", maxLoadMass: 0,
        localizationTypes: ["NATURAL"], navigationTypes: ["VIRTUAL_LINE_GUIDED"],
    },
    physicalParameters: {
        speedMin: 0, speedMax: 0.4, accelerationMax: 1, decelerationMax: 1, heightMax: 0.5, width: 0.3, length: 0.4,
    },
    protocolLimits: { maxStringLens: {}, maxArrayLens: {}, timing: { minOrderInterval: 0, minStateInterval: 0.1 } },
    protocolFeatures: { optionalParameters: [], agvActions: [] },
    agvGeometry: {},
    loadSpecification: {},
};

// The package knows 2.0 only: messages of 2.1 are checked by its schemas of 2.0, where instant actions have another name.
const lenient = Base => class extends Base {
    validateTopicObject(topic, object, version) {
        if (topic === lib.Topic.InstantActions) {
            object.actions = object.instantActions = object.actions ?? object.instantActions;
        }
        super.validateTopicObject(topic, { ...object, version }, version);
    }
};
const Master = lenient(lib.MasterController), Vehicle = lenient(lib.AgvController);

async function drive(orders) {
    const master = new Master(options, {});
    const places = {}, found = { processed: 0, cancelled: 0, errors: [] };
    await master.start();
    await master.subscribe(lib.Topic.State, { manufacturer: "mrpbench" }, state => {
        places[state.serialNumber] = state.agvPosition;
        found.errors.push(...state.errors.map(error => error.errorType));
    });

    // Sends an order or an update, and waits until all that is released of it is done.
    const assign = (agv, order, more = () => {}) => new Promise((resolve, reject) => {
        master.assignOrder(agv, order, {
            onOrderProcessed: (error, byCancelation, active) => {
                if (error !== undefined) { found.errors.push(error.errorType); }
                resolve({ byCancelation, active });
            },
            onNodeTraversed: more,
        }).catch(reject);
    });

    const trip = async serialNumber => {
        const agv = { manufacturer: "mrpbench", serialNumber };
        while (places[serialNumber] === undefined) { await new Promise(resolve => setTimeout(resolve, 100)); }
        for (let number = 0; number < orders; number++) {
            const here = places[serialNumber], step = here.x < 6 ? 1 : -1;
            const x = Math.round(here.x - 0.5) + 0.5, y = Math.round(here.y - 0.5) + 0.5;
            const parts = released => ({
                nodes: [0, 1, 2, 3].map(i => ({
                    nodeId: `${serialNumber}-${number}-${i}`, sequenceId: 2 * i, released: i < released, actions: [],
                    nodePosition: { x: x + i * step, y, mapId: "L1" },
                })),
                edges: [0, 1, 2].map(i => ({
                    edgeId: `${serialNumber}-${number}-e${i}`, sequenceId: 2 * i + 1, released: i + 1 < released,
                    startNodeId: `${serialNumber}-${number}-${i}`, endNodeId: `${serialNumber}-${number}-${i + 1}`,
                    actions: [],
                })),
            });
            const orderId = `${serialNumber}-${number}`, whole = parts(4);
            const { active } = await assign(agv, { orderId, orderUpdateId: 0, ...parts(2) });
            if (!active) { found.errors.push("the order ended with its base"); }
            const update = { orderId, orderUpdateId: 1, nodes: whole.nodes.slice(1), edges: whole.edges.slice(1) };
            const ended = assign(agv, update);
            if (number % 2) {
                await new Promise(resolve => setTimeout(resolve, 50));
                await master.initiateInstantActions(agv, {
                    instantActions: [{ actionId: master.createUuid(), actionType: "cancelOrder", blockingType: "HARD" }],
                }, {
                    onActionStateChanged: () => {},
                    onActionError: error => found.errors.push(error.errorType),
                });
            }
            const { byCancelation } = await ended;
            found[byCancelation ? "cancelled" : "processed"]++;
        }
    };
    await Promise.all(["robot_0", "robot_1", "robot_2"].map(trip));
    await master.stop();
    console.log(JSON.stringify(found));
}

async function serve(places) {
    for (const [index, place] of places.entries()) {
        const [x, y, theta] = place.split(",").map(Number);
        const vehicle = new Vehicle(
            { manufacturer: "lib", serialNumber: `v${index}` },
            options,
            { agvAdapterType: lib.VirtualAgvAdapter, publishStateInterval: 500, publishVisualizationInterval: 200 },
            { initialPosition: { mapId: "L1", x, y, theta, lastNodeId: "start" }, vehicleSpeed: 0.4, tickRate: 20 },
        );
        await vehicle.start();
        vehicle.updateFactsheet(FACTSHEET);
    }
    console.log("ready");
}

(role === "master" ? drive(Number(rest[0])) : serve(rest)).catch(error => {
    console.error(error);
    process.exit(1);
});
