MODULE world_zones(SYSMODULE)
  VAR wzstationary wzTable;
  VAR wztemporary wzDoor;
  PROC power_on()
    VAR shapedata box;
    CONST pos low:=[200,-500,-100];
    CONST pos high:=[900,500,150];
    WZBoxDef\Inside,box,low,high;
    WZLimSup\Stat,wzTable,box;
    WZCylDef\Outside,box,[0,0,0],900,2000;
    WZDOSet\Temp,wzDoor\Inside,box,doInDoor,1;
  ENDPROC
ENDMODULE
