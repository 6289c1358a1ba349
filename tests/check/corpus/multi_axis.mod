MODULE multi_axis
  PERS wobjdata wTable:=[FALSE,FALSE,"STN1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pW1:=[[120.5,33.1,12],[0.0,0.707107,0.707107,0.0],[0,0,-1,0],[9E+09,45,-90,9E+09,9E+09,9E+09]];
  CONST jointtarget jLoad:=[[0,0,0,0,30,0],[9E9,0,180,9E9,9E9,9E9]];
  PROC main()
    ActUnit STN1;
    MoveExtJ jLoad,vrot50,fine;
    MoveJ pW1,v500,z20,tool0\WObj:=wTable;
    EOffsOn pW1;
    EOffsOff;
    DeactUnit STN1;
  ENDPROC
ENDMODULE
