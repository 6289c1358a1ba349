MODULE moduleB
  PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
  CONST robtarget turned:=[[535,-211,661],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ [[-36,11,23,3,32,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\NoEOffs,v1000,z0,tool0;
    MoveL turned,v500,z50,tool0;
  ENDPROC
ENDMODULE
