MODULE CalibData
	PERS tooldata tGripper:=[TRUE,[[0,0,185.4],[1,0,0,0]],[3.2,[0,0,90],[1,0,0,0],0.01,0.01,0.005]];
	TASK PERS wobjdata wobjPallet:=[FALSE,TRUE,"",[[850,-300,120],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
	TASK PERS wobjdata wobjConv:=[FALSE,TRUE,"",[[400,620.5,310],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];
ENDMODULE
